
// The bins of a chi-square test, as it cut them: observed, expected, and their ratio, in the square of the
// domain's chart. A record holds a bin as [x0, x1, y0, y1, expected, error, observed].

const kMapSize = 240;
const kWorstBins = 6;

function svgNode(tag, attributes) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  return node;
}

function readBin([x0, x1, y0, y1, expected, error, observed]) {
  const area = (x1 - x0) * (y1 - y0);
  return {
    x0, x1, y0, y1, area, expected, error, observed,
    ratio: observed / expected,
    // of what counts vary by and the integral may be off by
    deviations: (observed - expected) / Math.sqrt(expected + error * error),
  };
}

/** Twice and half are in full colour; half a sample keeps empty bins on the scale. */
function ratioColour(bin) {
  const ratio = Math.log2((bin.observed + 0.5) / (bin.expected + 0.5));
  return {class: ratio > 0 ? 'more' : 'fewer', 'fill-opacity': Math.min(1, Math.abs(ratio))};
}

/** Darkness grows with the root of the density, so that faint parts are seen beside a peak. */
function densityColour(get, bins) {
  const densest = Math.max(...bins.map((b) => get(b) / b.area));
  return (bin) => ({class: 'density', 'fill-opacity': Math.sqrt(get(bin) / bin.area / densest) || 0});
}

const describeBin = (b) =>
  `[${formatNumber(b.x0, 4)}, ${formatNumber(b.x1, 4)}) × [${formatNumber(b.y0, 4)}, ${formatNumber(b.y1, 4)}): ` +
  `${b.observed.toLocaleString('en')} observed, ${formatNumber(b.expected, 6)} ± ${formatNumber(b.error, 2)} expected, ` +
  `ratio ${formatNumber(b.ratio, 3)}, ${formatNumber(b.deviations, 3)} standard deviations`;

function binMap(title, bins, colour, pointed) {
  const svg = svgNode('svg', {viewBox: `0 0 ${kMapSize} ${kMapSize}`, class: 'bins', role: 'img', 'aria-label': `${title} in each bin`});
  bins.forEach((bin, index) => {
    const rect = svgNode('rect', {
      x: kMapSize * bin.x0, y: kMapSize * (1 - bin.y1),
      width: kMapSize * (bin.x1 - bin.x0), height: kMapSize * (bin.y1 - bin.y0), ...colour(bin),
    });
    rect.addEventListener('pointerenter', () => pointed(index));
    svg.append(rect);
  });
  return {svg, figure: element('figure', {className: 'bin-map'}, element('figcaption', {}, title), svg)};
}

function worstBins(bins) {
  const worst = [...bins].sort((a, b) => Math.abs(b.deviations) - Math.abs(a.deviations)).slice(0, kWorstBins);
  const range = (low, high) => `${formatNumber(low, 4)} … ${formatNumber(high, 4)}`;
  return sortableTable([
    textColumn('x', (b) => range(b.x0, b.x1)),
    textColumn('y', (b) => range(b.y0, b.y1)),
    numberColumn('Observed', (b) => b.observed, (x) => x.toLocaleString('en')),
    numberColumn('Expected', (b) => b.expected, (x) => formatNumber(x, 5)),
    numberColumn('Ratio', (b) => b.ratio, (x) => formatNumber(x, 3)),
    numberColumn('Standard deviations', (b) => b.deviations, (x) => formatNumber(x, 3)),
  ], worst);
}

function binMaps(rows) {
  const bins = rows.map(readBin);
  const reading = element('p', {className: 'reading', role: 'status'}, 'Point at a bin to read it.');
  const maps = [];
  const pointed = (index) => {
    reading.textContent = describeBin(bins[index]);
    for (const {svg} of maps) [...svg.children].forEach((rect, i) => rect.classList.toggle('pointed', i === index));
  };
  maps.push(
    binMap('Observed', bins, densityColour((b) => b.observed, bins), pointed),
    binMap('Expected', bins, densityColour((b) => b.expected, bins), pointed),
    binMap('Observed over expected', bins, ratioColour, pointed));
  const legend = element('p', {className: 'legend'}, '½', element('i', {className: 'diverging'}), '2');
  return element('div', {className: 'bin-maps'},
    element('div', {className: 'maps'}, maps.map(({figure}) => figure)), legend, reading,
    element('h4', {}, 'Worst bins'), worstBins(bins));
}
