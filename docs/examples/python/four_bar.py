# A four-bar linkage: bars of 1, 2 and 1.5 by their angles, with weight; the loop closes by two constraints.
import courant
import numpy as np

def loop(q):
    return [np.cos(q[0]) + 2*np.cos(q[1]) - 1.5*np.cos(q[2]) - 2, np.sin(q[0]) + 2*np.sin(q[1]) - 1.5*np.sin(q[2])]

sol = courant.solve_lagrangian(lambda q, v: v @ v/2 - np.sin(q) @ [1, 2, 1.5], (0, 5), [1.0, 0.5, 1.5], [0, 0, 0], holonomic=loop, step=0.01)
print(sol.ladder)
print("loop:", np.abs(loop(sol["q"])).max(), "energy:", np.ptp(sol.energy))
