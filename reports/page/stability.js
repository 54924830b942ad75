
// What rounding costs each function of each BSDF: float against quad precision.

const kStabilityFunctions = ['sample', 'eval', 'pdf', 'weight'];
const kHalfUlp = 2 ** -24;

const isStable = (record) => toNumber(record.error) <= record.tolerance;

/** A number over a bar that grows with its logarithm, from half an ulp to the tolerance. */
function errorCell(record) {
  if (!record) return element('td', {className: 'number none'}, '–');
  const error = toNumber(record.error);
  const share = Math.log(error / kHalfUlp) / Math.log(record.tolerance / kHalfUlp);
  const width = error > 0 ? 100 * Math.min(1, Math.max(0, share)) : 0;
  return element(
    'td',
    {className: `number rounding${isStable(record) ? '' : ' bad-number'}`, title: record.place || null},
    formatNumber(error, 2),
    element('i', {}, element('b', {style: `width:${Number.isNaN(width) ? 100 : width}%`})),
  );
}

const placesColumns = [
  textColumn('Function', (r) => r.function),
  numberColumn('Points', (r) => r.points, formatCount),
  numberColumn('Largest error', (r) => r.error, (x) => formatNumber(x, 3)),
  textColumn('at', (r) => r.place || '–', {className: 'place'}),
  numberColumn('Ill-conditioned', (r) => r.ill_conditioned, formatCount),
  numberColumn('Error there', (r) => (r.ill_conditioned > 0 ? r.ill_conditioned_error : null), (x) => formatNumber(x, 3)),
  numberColumn('Condition number', (r) => (r.ill_conditioned > 0 ? r.condition : null), (x) => formatNumber(x, 3)),
  textColumn('at', (r) => r.ill_conditioned_place || '–', {className: 'place'}),
];

function stabilityRow(name, records) {
  const values = [...records.values()];
  const hard = values.filter((r) => r.ill_conditioned > 0);
  const conditions = hard.map((r) => toNumber(r.condition));
  const sum = (get) => values.reduce((total, record) => total + get(record), 0);
  const count = hard.length > 0 ? formatCount(sum((r) => r.ill_conditioned)) : '–';
  const condition = hard.length > 0 ? formatNumber(Math.max(...conditions), 2) : '–';
  const stable = values.every(isStable);
  const row = element(
    'tr',
    {className: `check${stable ? '' : ' unexpected'}`},
    element('td', {}, element('button', {type: 'button'}, name.split('/').slice(1).join('/') || name)),
    kStabilityFunctions.map((f) => errorCell(records.get(f))),
    element('td', {className: 'number'}, formatCount(sum((r) => r.points))),
    element('td', {className: `number${count === '–' ? ' none' : ''}`}, count),
    element('td', {className: `number${condition === '–' ? ' none' : ''}`}, condition),
  );
  const toggle = openOnClick(row, () =>
    element('tr', {className: 'details'},
      element('td', {colspan: kStabilityFunctions.length + 4}, sortableTable(placesColumns, values))));
  return {row, open: stable ? null : toggle};
}

function stabilityTable() {
  const heading = ['BSDF', ...kStabilityFunctions, 'Points', 'Ill-conditioned', 'Condition number'];
  const table = element('table', {className: 'stability'}, element('thead', {}, element('tr', {},
    heading.map((text, i) => element('th', {scope: 'col', className: i > 0 ? 'number' : null}, text)))));
  const kinds = [...groupBy(data.stability, (r) => r.bsdf.split('/')[0])];
  for (const [kind, ofKind] of kinds.sort((a, b) => naturalOrder(a[0], b[0]))) {
    const body = element('tbody', {}, element('tr', {className: 'group'},
      element('td', {colspan: heading.length}, element('strong', {}, nameOf(kind)))));
    for (const [name, records] of groupBy(ofKind, (r) => r.bsdf)) {
      const {row, open} = stabilityRow(name, new Map(records.map((r) => [r.function, r])));
      body.append(row);
      open?.();
    }
    table.append(body);
  }
  return element('div', {className: 'scroll'}, table);
}

function addStability() {
  if (data.stability.length === 0) return;
  const tolerances = [...new Set(data.stability.map((r) => formatNumber(r.tolerance)))].join(', ');
  addView({
    id: 'stability',
    group: 'Quality',
    title: 'Numerical stability',
    count: data.stability.length,
    about: 'Float as rendered against the same code in quad precision at hard points: the largest relative error of each ' +
      `function (of the sampled direction the absolute one). Bars run from half an ulp to the tolerance, ${tolerances}. ` +
      'Ill-conditioned are points where one ulp of the inputs already changes the answer by as much; these show a ' +
      'condition number instead, ∞ where one ulp decides whether there is a sample. A row opens to show the places.',
    make: () => [stabilityTable()],
  });
}
