
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

function checkDetails(check) {
  return element('tr', {className: `details${check.as_expected ? '' : ' unexpected'}`},
    element('td', {colspan: checkColumns.length}, checkReport(check),
      element('p', {className: 'back'}, element('a', {href: checkAddress(check)}, 'Link to this check'))));
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

/** Rows of one suite that are made without being asked for, and details opened without a click. */
const kRowsAtOnce = 200;
const kDetailsAtOnce = 5;

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
    const button = element('button', {type: 'button', title: name, 'aria-expanded': String(open)}, nameOf(name));
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
    const sorted = this.sorted(checks);
    this.addRows(body, sorted.slice(0, kRowsAtOnce));
    if (sorted.length > kRowsAtOnce) body.append(this.moreRow(body, sorted.slice(kRowsAtOnce)));
    return body;
  }

  addRows(body, checks) {
    checks.forEach((check, index) => {
      const {row, open} = checkRow(check);
      body.append(row);
      if (!check.as_expected && index < kDetailsAtOnce) open();
    });
  }

  moreRow(body, checks) {
    const row = element('tr', {}, element('td', {colspan: checkColumns.length}, element('button', {
      type: 'button',
      className: 'more-rows',
      onclick: () => {
        row.remove();
        this.addRows(body, checks.slice(0, 5 * kRowsAtOnce));
        if (checks.length > 5 * kRowsAtOnce) body.append(this.moreRow(body, checks.slice(5 * kRowsAtOnce)));
      },
    }, `${checks.length} more`)));
    return row;
  }
}

function addChecks() {
  if (data.checks.length === 0) return;
  let table = null;
  addView({
    id: 'checks',
    group: 'Verdict',
    title: 'Checks',
    count: data.checks.length,
    about: 'A pass proves a bound on the bias, a fail proves a difference, anything else is inconclusive. ' +
      'Each check declares the verdict it must give; a row opens on a click.',
    make: () => {
      table = new CheckTable(data.checks);
      return table.node();
    },
    open: (section, [kind]) => {
      if (kind && table.kinds.includes(kind)) table.showAll(kind);
    },
  });
}
