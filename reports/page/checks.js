
// The table of checks, grouped by suite, and the table of variance ratios.

const suiteOf = (check) => check.subject.split('/')[0];
const nameInSuite = (check) => check.subject.slice(suiteOf(check).length + 1) || check.subject;

/** Bounds and effects are easiest to judge relative to the known answer. */
function relativeToReference(check, value) {
  const reference = Math.abs(toNumber(check.reference));
  return reference > 0 && Number.isFinite(reference)
    ? formatPercent(toNumber(value) / reference)
    : formatNumber(value, 3);
}

const checkColumns = [
  {name: 'Subject', sort: nameInSuite, cell: (c) => element('button', {type: 'button'}, nameInSuite(c))},
  textColumn('Check', (c) => c.check),
  {name: 'Verdict', sort: (c) => c.verdict, cell: verdictBadge},
  {
    name: 'Expected',
    sort: (c) => c.expected,
    cell: (c) => element('span', {className: c.as_expected ? 'muted' : 'bad-number'}, c.expected),
  },
  numberColumn('Estimate', (c) => c.estimate, (x) => formatAligned(x)),
  numberColumn('Reference', (c) => c.reference, (x) => formatAligned(x)),
  {
    name: 'Proven bound',
    title: '|bias| is at most this with 99.9 % confidence; relative to the reference where there is one',
    number: true,
    sort: (c) => toNumber(c.bound) / Math.abs(toNumber(c.reference) || 1),
    cell: (c) => relativeToReference(c, c.bound),
  },
  {
    name: 'Detectable',
    title: 'The smallest effect that fails with 99 % probability',
    number: true,
    sort: (c) => toNumber(c.detectable) / Math.abs(toNumber(c.reference) || 1),
    cell: (c) => relativeToReference(c, c.detectable),
  },
  numberColumn('Samples', (c) => c.samples, formatCount),
  numberColumn('Seconds', (c) => c.seconds, formatSeconds),
  textColumn('Leaned on', (c) => c.leaned_on, {className: 'wrap muted'}),
];

function fact(name, value) {
  return value === '–' || value === '' ? null : element('div', {}, element('dt', {}, name), element('dd', {}, value));
}

function copyButton(text) {
  const button = element('button', {
    type: 'button',
    onclick: async () => {
      try {
        await navigator.clipboard.writeText(text);
        button.textContent = 'Copied';
      } catch {
        button.textContent = 'Select it';
      }
    },
  }, 'Copy');
  return button;
}

/** The bins of a chi-square test in the square of the domain's chart, by how many samples they hold of those expected. */
function binMap(bins) {
  const size = 240;
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', `0 0 ${size} ${size}`);
  svg.setAttribute('class', 'bins');
  svg.setAttribute('role', 'img');
  svg.setAttribute('aria-label', 'Samples in each bin against those expected');
  for (const [x0, x1, y0, y1, expected, error, observed] of bins) {
    const rect = document.createElementNS('http://www.w3.org/2000/svg', 'rect');
    const ratio = Math.log2((observed + 0.5) / (expected + 0.5));
    const box = {x: size * x0, y: size * (1 - y1), width: size * (x1 - x0), height: size * (y1 - y0)};
    for (const [name, value] of Object.entries(box)) rect.setAttribute(name, value);
    rect.setAttribute('class', ratio > 0 ? 'more' : 'fewer');
    rect.setAttribute('fill-opacity', Math.min(1, Math.abs(ratio)));
    const title = document.createElementNS('http://www.w3.org/2000/svg', 'title');
    title.textContent = `${observed} samples, ${formatNumber(expected, 6)} ± ${formatNumber(error, 2)} expected`;
    rect.append(title);
    svg.append(rect);
  }
  return element('figure', {className: 'bin-map'}, svg,
    element('figcaption', {}, 'The bins in the square of the domain’s chart: more samples than the pdf says, or fewer; in full at twice and half'));
}

function checkDetails(check) {
  const why = check.reason || (check.as_expected ? '' : `Expected ${check.expected}, got ${check.verdict}.`);
  return element(
    'tr',
    {className: `details${check.as_expected ? '' : ' unexpected'}`},
    element(
      'td',
      {colspan: checkColumns.length},
      why ? element('p', {className: 'why'}, why) : null,
      check.advice ? element('p', {className: 'why'}, check.advice) : null,
      check.waived ? element('p', {className: 'why'}, `Waived: ${check.waived}`) : null,
      check.diagnosis ? element('p', {className: 'diagnosis'}, check.diagnosis) : null,
      check.bins ? binMap(check.bins) : null,
      element(
        'dl',
        {className: 'facts'},
        fact('99.9 % interval', formatInterval(check.interval_low, check.interval_high, 6)),
        fact('Tolerance', formatNumber(check.tolerance, 4)),
        fact('Proven bound, absolute', formatNumber(check.bound, 4)),
        fact('Detectable, absolute', formatNumber(check.detectable, 4)),
        fact('p-value', formatNumber(check.p_value, 3)),
        fact('Samples', check.samples.toLocaleString('en')),
        fact('Seed', check.seed),
        check.figures.map(([name, value]) => fact(name, formatNumber(value, 6))),
      ),
      check.replay
        ? element('div', {className: 'replay'}, element('code', {}, check.replay), copyButton(check.replay))
        : null,
    ),
  );
}

function checkRow(check) {
  const row = element(
    'tr',
    {className: `check${check.as_expected ? '' : ' unexpected'}`},
    checkColumns.map((column) => bodyCell(column, check)),
  );
  return {row, open: openOnClick(row, () => checkDetails(check))};
}

function suiteSummary(checks) {
  const unexpected = checks.filter((c) => !c.as_expected).length;
  const seconds = checks.reduce((sum, c) => sum + toNumber(c.seconds), 0);
  const counts = ['pass', 'fail', 'inconclusive']
    .map((verdict) => [verdict, checks.filter((c) => c.verdict === verdict).length])
    .filter(([, count]) => count > 0)
    .map(([verdict, count]) => `${count} ${verdict}`);
  return [
    element('span', {className: 'muted'}, `${counts.join(', ')} · ${formatSeconds(seconds)} s`),
    unexpected > 0 ? element('span', {className: 'bad-number muted'}, `${unexpected} unexpected`) : null,
  ];
}

/** Above this many checks, suites in which nothing is unexpected start closed. */
const kOpenAtStart = 60;

class CheckTable {
  constructor(checks) {
    this.checks = checks;
    this.sort = {column: null, sign: 1};
    this.words = [];
    this.kind = 'all';
    this.opened = new Map();
    this.head = element('thead');
    this.table = element('table', {}, this.head);
    this.count = element('span', {className: 'count', role: 'status'});
    this.kinds = ['all', 'unexpected', 'pass', 'fail', 'inconclusive'];
    if (checks.some((check) => check.waived)) this.kinds.push('waived');
    this.chips = this.kinds.map((kind) =>
      element('button', {type: 'button', onclick: () => this.show(kind)}, kind[0].toUpperCase() + kind.slice(1)));
    this.draw();
  }

  node() {
    this.search = element('input', {
      type: 'search',
      placeholder: 'Filter by words, e.g. furnace mis',
      'aria-label': 'Filter checks',
      oninput: (event) => {
        this.words = event.target.value.toLowerCase().split(/\s+/).filter(Boolean);
        this.draw();
      },
    });
    return [
      element('div', {className: 'filters'}, this.search,
        element('div', {className: 'chips', role: 'group', 'aria-label': 'Verdict'}, this.chips), this.count),
      element('div', {className: 'scroll'}, this.table),
    ];
  }

  show(kind) {
    this.kind = kind;
    this.draw();
  }

  /** All checks of a kind, whatever words were typed before. */
  showAll(kind) {
    this.search.value = '';
    this.words = [];
    this.show(kind);
  }

  matches(check) {
    const text = `${check.subject} ${check.check} ${check.verdict} ${check.leaned_on}`.toLowerCase();
    const kindFits = this.kind === 'all' || this.kind === check.verdict ||
      (this.kind === 'unexpected' && !check.as_expected) || (this.kind === 'waived' && check.waived);
    return kindFits && this.words.every((word) => text.includes(word));
  }

  draw() {
    this.chips.forEach((chip, i) => chip.setAttribute('aria-pressed', String(this.kinds[i] === this.kind)));
    this.head.replaceChildren(
      element('tr', {}, checkColumns.map((c) => headerCell(c, this.sort, () => this.draw()))));
    const shown = this.checks.filter((check) => this.matches(check));
    this.count.textContent =
      shown.length === this.checks.length ? `${shown.length} checks` : `${shown.length} of ${this.checks.length} checks`;
    const suites = [...groupBy(shown, suiteOf)];
    const unexpected = (checks) => checks.filter((c) => !c.as_expected).length > 0;
    suites.sort((a, b) => unexpected(b[1]) - unexpected(a[1]) || naturalOrder(a[0], b[0]));
    this.table.replaceChildren(this.head, ...suites.map(([name, checks]) => this.suite(name, checks)));
  }

  sorted(checks) {
    const {column, sign} = this.sort;
    const byColumn = (a, b) => (column ? compareValues(column.sort(a), column.sort(b), sign) : 0);
    return [...checks].sort((a, b) => a.as_expected - b.as_expected || byColumn(a, b));
  }

  startsOpen(checks) {
    const filtered = this.words.length > 0 || this.kind !== 'all';
    return filtered || this.checks.length <= kOpenAtStart || checks.some((c) => !c.as_expected);
  }

  suite(name, checks) {
    const open = this.opened.get(name) ?? this.startsOpen(checks);
    const button = element('button', {type: 'button', 'aria-expanded': String(open)}, name);
    const heading = element(
      'tr',
      {
        className: 'group',
        onclick: () => {
          this.opened.set(name, !open);
          this.draw();
        },
      },
      element('td', {colspan: checkColumns.length}, button, suiteSummary(checks)),
    );
    const body = element('tbody', {}, heading);
    if (!open) return body;
    for (const check of this.sorted(checks)) {
      const {row, open: openDetails} = checkRow(check);
      body.append(row);
      if (!check.as_expected) openDetails();
    }
    return body;
  }
}

function addChecks() {
  if (data.checks.length === 0) return null;
  const table = new CheckTable(data.checks);
  addSection('checks', 'Checks', data.checks.length,
    'A pass proves a bound on the bias, a fail proves a difference, anything else is inconclusive. ' +
    'Each check declares the verdict it must give; a row opens on a click.', ...table.node());
  return table;
}

function addVarianceRatios() {
  const ratios = data.checks.filter((c) => c.check === 'variance_ratio');
  if (ratios.length === 0) return;
  const scale = makeScale(ratios.flatMap((c) => [c.estimate, c.interval_low, c.interval_high]), true);
  const columns = [
    textColumn('Suite', suiteOf),
    textColumn('Compared', nameInSuite, {className: 'mono'}),
    numberColumn('Ratio', (c) => c.estimate, (x) => formatAligned(x, 3)),
    {
      name: '99.9 % interval',
      number: true,
      cell: (c) => formatInterval(c.interval_low, c.interval_high),
    },
    intervalColumn('', scale, (c) => ({low: c.interval_low, value: c.estimate, high: c.interval_high})),
    {name: 'Verdict', sort: (c) => c.verdict, cell: verdictBadge},
    numberColumn('Samples', (c) => c.samples, formatCount),
  ];
  addSection('variance', 'Variance ratios', ratios.length,
    'Variance of the first estimator over that of the second, equal samples. At 1 they are equally good; ' +
    'an interval that does not touch 1 is a difference.', sortableTable(columns, ratios));
}

// What the checks claim about themselves, measured: rows of `plumbline calibrate`.

const calibrationTables = {
  'p-values of correct code': 'Share of p-values below the level tested: uniform p-values, or a level is not what it says.',
  'false failures': 'Share of runs of a correct but skewed estimator that fail.',
  'detection': 'Share of runs that find an error as large as the check promises to find in 99 of 100.',
  'coverage': 'Share of intervals that hold the true ratio of two variances.',
  'same code twice': 'Share of runs that claim a difference between identical things.',
};

function addCalibration() {
  const rows = data.checks.filter((c) => c.check === 'calibration');
  if (rows.length === 0) return;
  const part = (check, index) => check.subject.split('/')[index];
  const figure = (check, name) => check.figures.find(([key]) => key === name)?.[1];
  const columns = [
    textColumn('', (c) => c.subject.split('/').slice(2).join('/')),
    numberColumn('Runs', (c) => c.samples, formatCount),
    numberColumn('Measured', (c) => c.estimate, (x) => formatNumber(x, 4)),
    {name: '99.9 % interval', number: true, cell: (c) => formatInterval(c.interval_low, c.interval_high)},
    {name: 'Must lie in', number: true, cell: (c) => formatInterval(figure(c, 'at least'), figure(c, 'at most'))},
    {name: 'Verdict', sort: (c) => c.verdict, cell: verdictBadge},
  ];
  const tables = [...groupBy(rows, (c) => part(c, 1))].flatMap(([name, group]) => [
    element('h3', {}, name),
    element('p', {className: 'muted'}, calibrationTables[name] ?? ''),
    sortableTable(columns, group),
  ]);
  addSection('calibration', 'Calibration and power', rows.length,
    'The checks on code whose answer is known: how often they fail what is right, and how often they find what is wrong. ' +
    'A pass proves that the true rate lies in the range; controls, tests known to be badly calibrated, must fail.', ...tables);
}
