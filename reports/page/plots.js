
// Plots by Chart.js: error against time, and the figures that benches and suites hand in.

const kStrategies = ['bsdf', 'light', 'uniform', 'mis', 'one-sample'];
const kFurther = ['other-1', 'other-2', 'other-3'];
const kOthers = ['light', 'bsdf', 'mis', 'one-sample', 'other-1', 'other-2', 'other-3', 'uniform'];
const kMarkers = ['rect', 'triangle', 'crossRot', 'circle', 'rectRot', 'star'];

const cssColor = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** Bars for data points that carry `low` and `high`. */
const intervalBars = {
  id: 'intervalBars',
  afterDatasetsDraw(chart) {
    const {ctx, chartArea, scales} = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(chartArea.left, chartArea.top, chartArea.width, chartArea.height);
    ctx.clip();
    chart.data.datasets.forEach((dataset, index) => {
      if (!chart.isDatasetVisible(index)) return;
      ctx.strokeStyle = dataset.borderColor;
      ctx.lineWidth = 1;
      for (const {x, low, high} of dataset.data) {
        if (!(low <= high)) continue;
        const at = scales.x.getPixelForValue(x);
        const bottom = low > 0 || scales.y.type !== 'logarithmic' ? scales.y.getPixelForValue(low) : chartArea.bottom;
        const top = scales.y.getPixelForValue(high);
        ctx.beginPath();
        ctx.moveTo(at, bottom);
        ctx.lineTo(at, top);
        ctx.moveTo(at - 3, top);
        ctx.lineTo(at + 3, top);
        ctx.moveTo(at - 3, bottom);
        ctx.lineTo(at + 3, bottom);
        ctx.stroke();
      }
    });
    ctx.restore();
  },
};

const kSuperscripts = {'-': '⁻', 0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹'};

/** Powers of ten as 10⁻³; on a short axis also 2 and 5 times them. */
function logTick(value, short) {
  const exponent = Math.floor(Math.log10(value) + 1e-9);
  const mantissa = Math.round(value / 10 ** exponent);
  if (mantissa !== 1 && !(short && (mantissa === 2 || mantissa === 5))) return '';
  if (Math.abs(exponent) <= 2) return String(Number(value.toPrecision(3)));
  const power = '10' + [...String(exponent)].map((c) => kSuperscripts[c]).join('');
  return mantissa === 1 ? power : `${mantissa}·${power}`;
}

function axisOptions({label, log}) {
  const line = cssColor('line');
  const muted = cssColor('muted');
  const short = (scale) => Math.log10(scale.max / scale.min) < 2.2;
  return {
    type: log ? 'logarithmic' : 'linear',
    title: {display: true, text: label, color: muted},
    grid: {
      color: (context) =>
        log && context.tick && logTick(context.tick.value, short(context.scale)) === '' ? 'transparent' : line,
      borderColor: line,
    },
    ticks: {
      color: muted,
      autoSkip: !log,
      maxRotation: 0,
      callback: log ? function (value) { return logTick(value, short(this)); } : (value) => formatNumber(value, 4),
    },
  };
}

function chartOptions(x, y) {
  return {
    animation: false,
    maintainAspectRatio: false,
    layout: {padding: {right: 10}},  // for half of the last number of an axis
    interaction: {mode: 'nearest', intersect: false},
    scales: {x: axisOptions(x), y: axisOptions(y)},
    plugins: {
      legend: {
        position: 'bottom',
        labels: {
          color: cssColor('ink'), usePointStyle: true, boxHeight: 7, padding: 14,
          filter: (item, chart) => !chart.datasets[item.datasetIndex].unlisted,
        },
        onClick(event, item, legend) {
          const {chart} = legend;
          const name = chart.data.datasets[item.datasetIndex].curve;
          const visible = chart.isDatasetVisible(item.datasetIndex);
          chart.data.datasets.forEach((d, i) => {
            if (d.curve === name) chart.setDatasetVisibility(i, !visible);
          });
          chart.update();
        },
      },
      tooltip: {
        filter: (item) => !item.dataset.unlisted,
        callbacks: {
          title: () => '',
          label: ({dataset, raw}) => {
            const bars = raw.low <= raw.high ? `  [${formatInterval(raw.low, raw.high)}]` : '';
            return `${dataset.label}: ${formatNumber(raw.x, 3)}, ${formatNumber(raw.y, 3)}${bars}${raw.note ?? ''}`;
          },
        },
      },
    },
  };
}

const charts = [];

/**
 * A canvas whose chart is made when its view is first shown, and again when the colour scheme changes.
 * @param redraw  receives what draws the chart anew
 */
function plot(makeDatasets, x, y, label, {legend = true, redraw = () => {}} = {}) {
  const canvas = element('canvas', {role: 'img', 'aria-label': label});
  let chart = null;
  const draw = () => {
    chart?.destroy();
    const options = chartOptions(x, y);
    options.plugins.legend.display = legend;
    Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
    chart = new Chart(canvas, {
      type: 'scatter',
      data: {datasets: makeDatasets()},
      options,
      plugins: [intervalBars],
    });
  };
  charts.push({canvas, draw, stale: true});
  redraw(draw);
  return element('div', {className: 'plot'}, canvas);
}

/** Draws what is in the view shown and not yet drawn. */
function drawCharts() {
  for (const chart of charts) {
    if (!chart.stale || chart.canvas.offsetParent === null) continue;
    chart.draw();
    chart.stale = false;
  }
}

function redrawCharts() {
  for (const chart of charts) chart.stale = true;
  drawCharts();
}

// Error against time

function curveName(curve, samplers) {
  return [curve.strategy, curve.heuristic, samplers > 1 ? curve.sampler : ''].filter(Boolean).join(', ');
}

/** One colour per strategy everywhere; what differs in the heuristic or sampler gets another marker. */
function curveStyle(curve, curves) {
  const siblings = curves.filter((c) => c.strategy === curve.strategy);
  const known = kStrategies.includes(curve.strategy);
  const others = [...new Set(curves.map((c) => c.strategy))].filter((s) => !kStrategies.includes(s));
  const index = siblings.indexOf(curve);
  return {
    color: known ? curve.strategy : kFurther[others.indexOf(curve.strategy) % kFurther.length],
    marker: kMarkers[(Math.max(0, kStrategies.indexOf(curve.strategy)) + index) % kMarkers.length],
    dash: [[], [5, 4], [2, 3], [8, 3, 2, 3]][index % 4],
  };
}

/** Of many curves those that a reader looks for first; the table shows the others. */
function shownAtFirst(curve, curves) {
  if (curves.length <= 10) return true;
  if (curve.strategy === 'mis') return curve.heuristic === 'power';
  return curve.sampler === 'independent' && ['', 'balance', 'root-v2'].includes(curve.heuristic);
}

const rootError = (relMse) => Math.sqrt(toNumber(relMse));

function curveDatasets(scene, samplers, shown) {
  return scene.curves.flatMap((curve) => {
    const {color, marker, dash} = curveStyle(curve, scene.curves);
    const name = curveName(curve, samplers);
    const times = curve.points.map((p) => p.seconds);
    const fitted = [Math.min(...times), Math.max(...times)].map((x) => ({
      x,
      y: toNumber(curve.factor) * x ** toNumber(curve.slope),
    }));
    const common = {curve: name, hidden: !shown.has(curve), borderColor: cssColor(color), backgroundColor: cssColor(color)};
    return [
      {
        ...common,
        label: name,
        pointStyle: marker,
        pointRadius: 4,
        pointBorderWidth: 1.5,
        data: curve.points.map((p) => ({
          x: p.seconds,
          y: rootError(p.rel_mse),
          low: rootError(p.rel_mse_low),
          high: rootError(p.rel_mse_high),
          note: `  ${p.spp} spp`,
        })),
      },
      {...common, label: `${name}, fit`, unlisted: true, showLine: true, pointRadius: 0, borderWidth: 1.5,
        borderDash: dash, data: falls(curve) ? fitted : []},
    ];
  });
}

/** 1/(relMSE · time), the geometric mean over the points. */
function efficiency(curve) {
  const logs = curve.points.map((p) => -Math.log(p.rel_mse * p.seconds));
  return Math.exp(logs.reduce((a, b) => a + b, 0) / logs.length);
}

/** Where the fit is sure to fall; a line that may as well rise says nothing of what lies beyond the points. */
const falls = (curve) => toNumber(curve.slope) + 2 * toNumber(curve.slope_error) < 0;
const timeTo = (error, curve) =>
  falls(curve) ? (error / toNumber(curve.factor)) ** (1 / toNumber(curve.slope)) : NaN;

/** One row per curve; a box shows or hides it in the plot. */
function curveTable(scene, samplers, shown, redraw) {
  const best = Math.max(...scene.curves.map(efficiency).filter(Number.isFinite));
  const last = (curve) => curve.points[curve.points.length - 1];
  const box = (curve) => element('input', {
    type: 'checkbox', checked: shown.has(curve), style: `accent-color:var(--${curveStyle(curve, scene.curves).color})`,
    onchange: (event) => {
      if (event.target.checked) shown.add(curve);
      else shown.delete(curve);
      redraw();
    },
  });
  const columns = [
    {
      name: 'Curve',
      sort: (c) => curveName(c, samplers),
      cell: (c) => element('label', {}, box(c),
        element('span', {className: 'swatch', style: `background:var(--${curveStyle(c, scene.curves).color})`}),
        curveName(c, samplers)),
    },
    {
      name: 'Slope',
      title: 'Exponent of error ~ time^slope with its standard error; −1/2 for a plain Monte Carlo estimator',
      number: true,
      sort: (c) => toNumber(c.slope),
      cell: (c) =>
        Number.isFinite(toNumber(c.slope_error))
          ? `${minus(toNumber(c.slope).toFixed(2))} ± ${toNumber(c.slope_error).toFixed(2)}`
          : '–',
    },
    numberColumn('1 % after [s]', (c) => timeTo(0.01, c), (x) => formatAligned(x, 3),
      {title: 'Time to a relative error of 1 %, from the fitted line where it surely falls; beyond the measured points it is an extrapolation'}),
    numberColumn('Efficiency', (c) => efficiency(c) / best, (x) => formatAligned(x, 3),
      {title: '1/(relMSE · seconds), geometric mean over the points, relative to the best here'}),
    {
      name: 'relMSE',
      number: true,
      sort: (c) => toNumber(last(c).rel_mse),
      cell: ({points}) => {
        const {rel_mse: value, rel_mse_low: low, rel_mse_high: high} = points[points.length - 1];
        return `${formatNumber(value, 3)} [${formatInterval(Math.max(toNumber(low), 0), high, 2)}]`;
      },
    },
    numberColumn('Seconds', (c) => last(c).seconds, (x) => formatAligned(x, 3)),
    numberColumn('Rays', (c) => last(c).rays, formatCount),
  ];
  return sortableTable(columns, scene.curves);
}

function speedCard(scene, samplers) {
  const x = {label: 'time of one render [s]', log: true};
  const y = {label: 'relative error (root of relMSE)', log: true};
  const shown = new Set(scene.curves.filter((curve) => shownAtFirst(curve, scene.curves)));
  let draw = () => {};
  const picture = plot(() => curveDatasets(scene, samplers, shown), x, y, `Error against time, ${scene.scene}`,
    {legend: false, redraw: (f) => { draw = f; }});
  return element('div', {className: 'card'},
    element('h3', {}, scene.scene, element('span', {className: 'aside'}, replicates(scene))),
    element('div', {className: 'plot-and-table'}, picture, curveTable(scene, samplers, shown, () => draw())));
}

function replicates(scene) {
  const points = scene.curves.flatMap((curve) => curve.points);
  const counts = points.map((p) => p.replicates);
  const [low, high] = [Math.min(...counts), Math.max(...counts)];
  return `${low === high ? low : `${low} to ${high}`} replicates of each point; relMSE, seconds and rays at ` +
    `${Math.max(...points.map((p) => p.spp))} samples per pixel`;
}

function addSpeed() {
  if (data.speed.length === 0) return;
  const samplers = new Set(data.speed.flatMap((s) => s.curves.map((c) => c.sampler))).size;
  addView({
    id: 'speed',
    group: 'Speed',
    title: 'Error against time',
    count: data.speed.length,
    about: 'Lower and further left is better; the boxes show or hide curves. Bars: 95 % intervals over independent ' +
      'replicates. Lines: the fitted power law; a plain Monte Carlo estimator falls with slope −1/2.',
    make: () => data.speed.map((scene) => speedCard(scene, samplers)),
  });
}

// What shadow rays cost

function addRayCosts() {
  const costs = data.ray_costs;
  if (costs.length === 0) return;
  const scale = makeScale(costs.flatMap((c) => [c.ratio_low, c.ratio, c.ratio_high]), false);
  const columns = [
    textColumn('Scene', (c) => c.scene),
    textColumn('Rays', (c) => c.rays),
    numberColumn('Width', (c) => c.width, String),
    numberColumn('Occluded', (c) => c.occluded_fraction, (x) => `${(100 * x).toFixed(1)} %`),
    numberColumn('rtcIntersect [ns]', (c) => c.intersect_ns, (x) => formatAligned(x, 4)),
    numberColumn('rtcOccluded [ns]', (c) => c.occluded_ns, (x) => formatAligned(x, 4)),
    numberColumn('Ratio', (c) => c.ratio, (x) => x.toFixed(3)),
    {name: '95 % interval', number: true, cell: (c) => formatInterval(c.ratio_low, c.ratio_high)},
    intervalColumn('', scale, (c) => ({low: c.ratio_low, value: c.ratio, high: c.ratio_high})),
  ];
  addView({
    id: 'shadow-rays',
    group: 'Speed',
    title: 'Shadow rays',
    count: costs.length,
    about: 'The same recorded rays, asked whether anything is in the way (rtcOccluded) and what is nearest ' +
      '(rtcIntersect), interleaved. Time per ray, and the ratio of the two.',
    make: () => [sortableTable(columns, costs)],
  });
}

// Figures

function figureDatasets(figure) {
  const curves = [...new Set(figure.series.map((series) => series.name))];
  return figure.series.map((series, position) => {
    const index = curves.indexOf(series.name);
    const name = kStrategies.find((s) => series.name === s || series.name.startsWith(`${s},`));
    const color = cssColor(name ?? kOthers[index % kOthers.length]);
    const measured = series.style === 'points';
    return {
      label: series.name,
      curve: series.name,
      unlisted: figure.series.findIndex((s) => s.name === series.name) !== position,
      borderColor: color,
      backgroundColor: color,
      showLine: true,
      borderWidth: measured ? 1 : 2,
      borderDash: series.style === 'dashed' ? [6, 4] : [],
      pointRadius: measured ? 3 : 0,
      pointStyle: measured ? kMarkers[index % kMarkers.length] : 'line',
      data: series.x.map((x, i) => ({
        x: toNumber(x),
        y: toNumber(series.y[i]),
        low: toNumber(series.low[i]),
        high: toNumber(series.high[i]),
      })).filter((p) => (!figure.x_axis.log || p.x > 0) && (!figure.y_axis.log || !(p.y <= 0))),
    };
  });
}

function plainTable({title, columns, rows}) {
  const cells = (tag, texts) =>
    element('tr', {}, texts.map((text, i) => element(tag, {className: i > 0 ? 'number' : ''}, text)));
  return scrollBox(title, element('table', {}, element('thead', {}, cells('th', columns)), element('tbody', {}, rows.map((row) => cells('td', row)))));
}

/** Groups that have a view of their own: what a history can see stands with the history. */
const figureGroups = () => groupBy([...data.figures, ...data.tables].filter((item) => item.group !== kHistoryFigures), (item) => item.group);

/** The name of the view of a group: its words, so that links outlive a new group. */
const figureViewOf = (group) => group === kHistoryFigures ? 'history' : `about-${group.toLowerCase().replace(/[^a-z0-9]+/g, '-')}`;

function figureCards(items) {
  const card = (item, content) => element('div', {className: 'card'}, element('h3', {}, item.title),
    element('p', {className: 'caption'}, item.caption), content);
  const tables = items.filter((item) => item.rows).map((item) => card(item, plainTable(item)));
  const plots = items.filter((item) => item.series).map((item) =>
    card(item, plot(() => figureDatasets(item), item.x_axis, item.y_axis, item.title)));
  return element('div', {}, tables, element('div', {className: 'plots'}, plots));
}

function addFigures() {
  for (const [group, items] of figureGroups()) {
    addView({
      id: figureViewOf(group),
      group: 'Measured',
      title: group,
      count: items.length,
      make: () => [figureCards(items)],
    });
  }
}
