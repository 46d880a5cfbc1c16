"""Figures by matplotlib in the style of reports."""

from __future__ import annotations

from courant import _courant as core


def house_axes(axes=None, *, figsize=(6.4, 3.6)):
    """Axes with the colours of reports, which are told apart by who does not see red or green, and without a frame."""
    import matplotlib.pyplot as plt

    if axes is None:
        axes = plt.subplots(figsize=figsize, constrained_layout=True)[1]
        axes.set_prop_cycle(color=core.palette())
        axes.spines[["top", "right"]].set_visible(False)
    return axes
