// The page: all of its charts, and its one instant.

const instant = new Instant();
const charts = [];
let timeLabel = 't';

function start() {
  for (const panel of document.querySelectorAll('svg .panel')) {
    const picture = panel.closest('svg');
    charts.push(panel.dataset.space ? new SpaceChart(picture) : new PlaneChart(picture));
  }
  const overTime = charts.find((chart) => chart.overTime);
  if (overTime) timeLabel = overTime.x.label;
  instant.build(document.querySelector('main > section'));
  // Only what can be seen is drawn while the instant moves.
  const seen = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      const chart = charts.find((one) => one.frame === entry.target);
      chart.shown = entry.isIntersecting;
      if (chart.shown) chart.drawNow();
    }
  });
  for (const chart of charts) seen.observe(chart.frame);
  document.documentElement.classList.add('scripted');
}

start();
