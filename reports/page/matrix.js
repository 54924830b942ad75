
// The matrix: things and what was varied of them against kinds of checks. A cell is all checks of one kind there.

/** Verdicts from the one that a cell shows before all others. */
const kCellTones = ['wrong', 'waived', 'inconclusive', 'control', 'pass'];
const kCellSigns = {wrong: '!', waived: 'w', inconclusive: '?', control: '×', pass: ''};
const kCellWords = {
  wrong: 'not the verdict it should give', waived: 'waived', inconclusive: 'rightly undecided',
  control: 'failed, as it must', pass: 'proven',
};
/** From what needs no sample to what needs many; kinds that are not named here come last. */
const kCheckOrder = [
  'finite', 'record_pdf', 'weight', 'support', 'reciprocity', 'atoms', 'inverse', 'jacobian_autodiff', 'jacobian', 'integral',
  'samples', 'chi_square', 'energy', 'proportion', 'mean', 'image', 'agreement', 'variance_ratio', 'variance',
];
const kRowsOfThing = 200;
const kChecksOfCell = 60;

let places = null;  // where each check stands; made when the matrix is first shown

function toneOf(check) {
  if (check.waived) return 'waived';
  if (!check.as_expected) return 'wrong';
  return check.verdict === 'fail' ? 'control' : check.verdict;
}

/** What is proven of the bias, relative to the known answer where there is one. */
function provenOf(check) {
  const reference = Math.abs(toNumber(check.reference));
  return toNumber(check.bound) / (reference > 0 && Number.isFinite(reference) ? reference : 1);
}

function summariseCell(checks) {
  const counts = groupBy(checks, toneOf);
  const proven = checks.map(provenOf).filter(Number.isFinite);
  const tone = kCellTones.find((t) => counts.has(t));
  return {tone, counts, mixed: tone === 'inconclusive' && counts.has('pass'), proven: proven.length > 0 ? Math.max(...proven) : NaN};
}

/** From faint at 10 % to full at 0.001 %; what has no bound is exact, or not about a size. */
function strengthOf(proven) {
  if (!(proven > 0)) return 1;
  return Math.max(0.3, Math.min(1, -Math.log10(proven) / 5));
}

/** "GGX conductor · alpha 1\nmean: 58 proven, 2 rightly undecided; at most 0.12 % off" */
function cellTitle(name, kind, checks, {counts, proven}) {
  const words = kCellTones.filter((tone) => counts.has(tone)).map((tone) => `${counts.get(tone).length} ${kCellWords[tone]}`);
  const bound = Number.isFinite(proven) ? `; at most ${formatPercent(proven)} off` : '';
  return `${name}\n${kind.replaceAll('_', ' ')}: ${words.join(', ')}${bound}`;
}

function cellList(checks) {
  const left = checks.length - kChecksOfCell;
  const order = [...checks].sort((a, b) => kCellTones.indexOf(toneOf(a)) - kCellTones.indexOf(toneOf(b)));
  return [
    element('ul', {className: 'cell-list'}, order.slice(0, kChecksOfCell).map((c) => element('li', {},
      verdictBadge(c), element('a', {href: checkAddress(c)}, c.subject),
      element('span', {className: 'muted'}, `≤ ${relativeToReference(c, c.bound)}`)))),
    left > 0 ? element('p', {className: 'muted'}, `and ${left} more`) : null,
  ];
}

/** Below a row what one of its cells holds; a second click takes it away. */
function toggleCell(button, checks, columns) {
  const row = button.closest('tr');
  const open = button.getAttribute('aria-expanded') === 'true';
  for (const other of row.querySelectorAll('[aria-expanded].cell')) other.setAttribute('aria-expanded', 'false');
  if (row.nextElementSibling?.matches('.details')) row.nextElementSibling.remove();
  if (open) return;
  button.setAttribute('aria-expanded', 'true');
  row.after(element('tr', {className: 'details'}, element('td', {colspan: columns.length + 2},
    checks.length === 1 ? checkCard(checks[0]) : cellList(checks))));
}

function matrixCell(name, kind, checks, columns) {
  if (!checks) return element('td', {});
  const summary = summariseCell(checks);
  const title = cellTitle(name, kind, checks, summary);
  return element('td', {}, element('button', {
    type: 'button', className: `cell ${summary.tone}${summary.mixed ? ' mixed' : ''}`, title, 'aria-label': title, 'aria-expanded': 'false',
    style: summary.tone === 'pass' ? `--strength:${strengthOf(summary.proven)}` : null,
    onclick: (event) => toggleCell(event.currentTarget, checks, columns),
  }, kCellSigns[summary.tone]));
}

function matrixRow(name, checks, columns, heading, className) {
  const byKind = groupBy(checks, (c) => c.check);
  return element('tr', {className}, element('th', {scope: 'row'}, heading),
    columns.map((kind) => matrixCell(name, kind, byKind.get(kind), columns)), element('td', {}));
}

/** A thing is one line, which opens to show what was varied of it. */
function matrixThing(thing, checks, columns) {
  const rows = [...groupBy(checks, (c) => places.get(c).row)].sort((a, b) => naturalOrder(a[0], b[0]));
  const button = element('button', {
    type: 'button', className: 'fold', 'aria-expanded': 'false',
    onclick: () => {
      const open = button.getAttribute('aria-expanded') === 'false';
      button.setAttribute('aria-expanded', String(open));
      if (open) showRows();
      else body.replaceChildren(head);
    },
  }, thing, element('span', {className: 'muted'}, String(rows.length)));
  const head = matrixRow(thing, checks, columns, rows.length > 1 ? button : element('span', {className: 'single'}, thing), 'thing');
  const body = element('tbody', {}, head);
  const showRows = () => {
    body.append(...rows.slice(0, kRowsOfThing).map(([name, list]) => matrixRow(`${thing} · ${name}`, list, columns, name, 'row')));
    if (rows.length > kRowsOfThing) {
      body.append(element('tr', {}, element('td', {colspan: columns.length + 2, className: 'muted'},
        `and ${rows.length - kRowsOfThing} more rows: find them by a word`)));
    }
  };
  return body;
}

function matrixTable(checks, columns) {
  const wrong = (list) => list.some((c) => toneOf(c) === 'wrong');
  const things = [...groupBy(checks, (c) => places.get(c).thing)]
    .sort((a, b) => wrong(b[1]) - wrong(a[1]) || naturalOrder(a[0], b[0]));
  return element('div', {className: 'scroll'}, element('table', {className: 'matrix'},
    element('thead', {}, element('tr', {}, element('th', {}),
      columns.map((kind) => element('th', {scope: 'col'}, element('span', {}, kind.replaceAll('_', ' ')))), element('th', {className: 'rest'}))),
    things.map(([thing, list]) => matrixThing(thing, list, columns))));
}

function matrixLegend() {
  return element('p', {className: 'matrix-legend'}, kCellTones.slice().reverse().map((tone) =>
    element('span', {}, element('i', {className: `cell ${tone}`}, kCellSigns[tone]), kCellWords[tone])),
    element('span', {className: 'muted'}, 'the fuller the green, the smaller the bound'));
}

/** Kinds of things in the order of kKinds, each with its checks; the controls come last and folded. */
function matrixGroups() {
  places = new Map(data.checks.map((check) => [check, placeOf(check)]));
  const groups = groupBy(data.checks, (c) => places.get(c).kind);
  const order = [...kKinds.map(([kind]) => kind), kControls];
  return order.filter((kind) => groups.has(kind)).map((kind) => [kind, groups.get(kind)]);
}

function matrixGroup(kind, checks) {
  const rank = (kind) => (kCheckOrder.indexOf(kind) + 1 || kCheckOrder.length + 1);
  const kinds = [...new Set(checks.map((c) => c.check))].sort((a, b) => rank(a) - rank(b));
  const table = () => matrixTable(checks, kinds);
  const heading = [kind, element('span', {className: 'aside'}, `${checks.length.toLocaleString('en')} checks`)];
  if (kind !== kControls) return element('section', {className: 'matrix-group'}, element('h3', {}, heading), table());
  const folded = element('details', {className: 'matrix-group'}, element('summary', {}, heading), element('p', {className: 'muted'},
    'Wrong on purpose: each must fail, which shows that the check can.'));
  folded.addEventListener('toggle', () => folded.append(table()), {once: true});
  return folded;
}

function addMatrix() {
  if (data.checks.length === 0) return;
  addView({
    id: 'matrix',
    group: 'Verdict',
    title: 'Matrix',
    about: 'What is checked, and how: a cell is all checks of one kind on one thing. Point at it to read what is proven; ' +
      'a click opens its checks, and a name what was varied.',
    make: () => [matrixLegend(), ...matrixGroups().map(([kind, checks]) => matrixGroup(kind, checks))],
  });
}
