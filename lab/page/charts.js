// The figures of runs: those of reports (reporting/page), one set at a time.

let moment = new Moment();
let charts = [];
let timeLabel = 't';
let seen = null;

// Brings the figures in an element to life; the bar with the moment goes before `first`.
export function startCharts(container, first) {
  if (seen) seen.disconnect();
  moment.pause();
  moment = new Moment();
  charts = [];
  timeLabel = 't';
  for (const panel of container.querySelectorAll('svg .panel')) {
    const picture = panel.closest('svg');
    charts.push(panel.dataset.space ? new SpaceChart(picture) : new PlaneChart(picture));
  }
  const overTime = charts.find((chart) => chart.overTime);
  if (overTime) timeLabel = overTime.x.label;
  if (charts.length > 0) moment.build(first);
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
  if (moment.button && !moment.playing) moment.play();
}
