// The figures of runs: those of reports (reporting/page), one set at a time.

let instant = new Instant();
let charts = [];
let timeLabel = 't';
let seen = null;

// Brings the figures in an element to life; the bar with the instant goes before `first`.
export function startCharts(container, first) {
  if (seen) seen.disconnect();
  instant.pause();
  instant = new Instant();
  charts = [];
  timeLabel = 't';
  for (const panel of container.querySelectorAll('svg .panel')) {
    const picture = panel.closest('svg');
    charts.push(panel.dataset.space ? new SpaceChart(picture) : new PlaneChart(picture));
  }
  const overTime = charts.find((chart) => chart.overTime);
  if (overTime) timeLabel = overTime.x.label;
  if (charts.length > 0) instant.build(first);
  seen = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      const chart = charts.find((one) => one.frame === entry.target);
      if (!chart) continue;
      chart.shown = entry.isIntersecting;
      if (chart.shown) chart.drawNow();
    }
  });
  for (const chart of charts) seen.observe(chart.frame);
}

export function playMotion() {
  if (instant.button && !instant.playing) instant.play();
}
