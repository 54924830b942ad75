
// Causes that the diagnosis named for code with known faults, against those that were put in.

const wasRight = (t) => t.named === t.expected;
const wasWrong = (t) => t.named !== '' && !wasRight(t);

/** "cosine, sine 2": names with how often, where it is more than once. */
function listCounted(names) {
  return [...groupBy(names, (n) => n)].sort((a, b) => naturalOrder(a[0], b[0]))
    .map(([name, list]) => (list.length > 1 ? `${name} ${list.length}` : name)).join(', ');
}

const countCell = (count, className = '') =>
  element('td', {className: `number ${count > 0 ? className : 'none'}`}, count > 0 ? String(count) : '–');

function causeCells(twins) {
  const wrong = twins.filter(wasWrong);
  return [
    countCell(twins.length),
    countCell(twins.filter(wasRight).length),
    countCell(wrong.length, 'bad-number'),
    countCell(twins.filter((t) => t.named === '').length),
    countCell(twins.filter((t) => !t.found).length, 'bad-number'),
    element('td', {className: `wrap${wrong.length > 0 ? '' : ' none'}`}, listCounted(wrong.map((t) => t.named)) || '–'),
  ];
}

const twinColumns = [
  textColumn('Set', (t) => t.set),
  textColumn('Code', (t) => t.name, {className: 'place'}),
  textColumn('Fault put in', (t) => t.fault, {className: 'wrap'}),
  {
    name: 'Named',
    sort: (t) => t.named,
    cell: (t) => element('span', {className: wasWrong(t) ? 'bad-number' : wasRight(t) ? null : 'none'}, t.named || 'none'),
  },
  {
    name: 'Found',
    sort: (t) => Number(t.found),
    cell: (t) => element('span', {className: t.found ? 'muted' : 'bad-number'}, t.found ? 'yes' : 'no'),
  },
];

function addCauses() {
  const twins = data.causes.flatMap((record) => record.twins.map((t) => ({...t, set: record.set})));
  if (twins.length === 0) return;
  const score = ({set, seed, twins: list}) =>
    `${set} set ${list.filter(wasRight).length} of ${list.length} (seed ${seed})`;
  addView({
    id: 'causes',
    group: 'Quality',
    title: 'Causes named',
    count: twins.length,
    about: 'Code with one fault put in, by its cause: whether the diagnosis names the right one, a wrong one or none, ' +
      'and faults that no check has found. Several names for the same count as one. ' +
      `Right: ${data.causes.map(score).join(', ')}. A row opens to show its twins, those named wrongly first.`,
    make: () => [causesTable(twins)],
  });
}

function causesTable(twins) {
  const heading = ['Cause put in', 'Twins', 'Right', 'Wrong', 'None', 'Missed', 'Wrongly named'];
  const body = element('tbody');
  for (const [cause, list] of [...groupBy(twins, (t) => t.expected)].sort((a, b) => naturalOrder(a[0], b[0]))) {
    const row = element('tr', {className: 'check'},
      element('td', {}, element('button', {type: 'button', 'aria-expanded': 'false'}, cause)), causeCells(list));
    const rank = (t) => (wasRight(t) ? 2 : wasWrong(t) ? 0 : 1);
    openOnClick(row, () =>
      element('tr', {className: 'details'}, element('td', {colspan: heading.length},
        sortableTable(twinColumns, [...list].sort((a, b) => rank(a) - rank(b))))));
    body.append(row);
  }
  body.append(element('tr', {className: 'total'}, element('td', {}, 'all'), causeCells(twins)));
  const head = element('thead', {}, element('tr', {}, heading.map((text, i) =>
    element('th', {scope: 'col', className: i > 0 && i < heading.length - 1 ? 'number' : null}, text))));
  return element('div', {className: 'scroll'}, element('table', {className: 'causes'}, head, body));
}
