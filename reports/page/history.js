
// What the nights of a history show together: what changed, each tracked number, what is proven by all nights, how
// their parts went, and the seeds that the gate was run with.

const kHistoryFigures = 'What a history can see';  // the group of figures that say so
const kNightsAtOnce = 30;

const dayOf = (night) => night.time.slice(0, 10);
const shortCommit = (commit) => commit.slice(0, 8) || '–';
const countOf = (count, one, many = `${one}s`) => `${count.toLocaleString('en')} ${count === 1 ? one : many}`;
const sumOf = (list, get) => list.reduce((sum, item) => sum + get(item), 0);

const numberAddress = (number) => addressOf('history', 'number', number.name);

/** All changes of the numbers, each with its number, the latest first. */
function changesOf(numbers) {
  return numbers.flatMap((number) => number.changes.map((change) => ({number, change})))
    .sort((a, b) => b.change.last_night - a.change.last_night);
}

function summariseHistory({nights, numbers, sequences}) {
  const changes = changesOf(numbers);
  return {
    regressions: changes.filter(({change}) => change.regression).length,
    improvements: changes.filter(({change}) => !change.regression).length,
    refuted: sequences.filter((s) => s.verdict === 'fail').length,
    gateRuns: sumOf(nights, (night) => night.gate_runs),
    failingRuns: sumOf(nights, (night) => night.failing_gate_runs),
  };
}

const isBad = ({regressions, refuted, failingRuns}) => regressions + refuted + failingRuns > 0;

/** "60 nights: 2 regressions, 1 improvement" */
function historyLine(record) {
  const {regressions, improvements} = summariseHistory(record);
  const changed = regressions + improvements === 0
    ? 'no number changed' : `${countOf(regressions, 'regression')}, ${countOf(improvements, 'improvement')}`;
  return `${countOf(record.nights.length, 'night')}: ${changed}`;
}

/** On the first view: what a history shows that needs a person's eyes. */
function historyNotices() {
  return data.history.flatMap((record) => {
    const found = summariseHistory(record);
    return isBad(found) ? [element('div', {className: 'notice'}, element('a', {href: '#history'}, historyLine(record)),
      `, ${countOf(found.refuted, 'check')} refuted, ${found.failingRuns} of ${countOf(found.gateRuns, 'fresh seed')} with a failure`)] : [];
  });
}

function historyVerdict(record) {
  const {nights, numbers, sequences} = record;
  const found = summariseHistory(record);
  const about = `${countOf(numbers.length, 'number')} and ${countOf(sequences.length, 'check')} followed from ` +
    `${dayOf(nights[0])} to ${dayOf(nights[nights.length - 1])}. Compared are only runs on the same machine with the same ` +
    `compiler and flags: ${record.machine}.`;
  const tile = (count, label, tone, part) => element('a', {className: `tile ${count > 0 ? tone : ''}`, href: addressOf('history', 'part', part)},
    element('b', {}, count.toLocaleString('en')), element('span', {}, label));
  return element('div', {className: `verdict ${isBad(found) ? 'bad' : 'good'}`},
    element('div', {}, element('p', {className: 'verdict-line'}, historyLine(record)), element('p', {}, about)),
    element('div', {className: 'tiles'},
      tile(found.regressions, 'regressions', 'fail', 'changes'),
      tile(found.improvements, 'improvements', 'pass', 'changes'),
      tile(found.refuted, 'checks refuted', 'fail', 'sequences'),
      tile(found.gateRuns, 'fresh seeds run', '', 'seeds'),
      tile(found.failingRuns, 'with a failure', 'fail', 'seeds')));
}

/** A part of the view that addresses and tiles lead to. */
function historyPart(name, title, about, ...content) {
  return element('section', {className: 'history-part', 'data-part': name},
    element('h3', {className: 'part'}, title), element('p', {className: 'caption'}, about), ...content);
}

// Changes

const changeKind = ({regression}) => (regression ? 'regression' : 'improvement');
const changeBadge = (change) =>
  element('span', {className: `badge ${change.regression ? 'fail wrong' : 'pass'}`}, changeKind(change));

/** "+2.1 %" */
function formatChange(relative) {
  const x = toNumber(relative);
  return Number.isNaN(x) ? '–' : `${x < 0 ? '−' : '+'}${formatPercent(x)}`;
}

function sinceWhen(change, nights) {
  const [first, last] = [nights[change.first_night], nights[change.last_night]];
  return change.drift ? `${dayOf(first)} … ${dayOf(last)}` : dayOf(first);
}

const betweenCommits = (change) => element('code', {},
  `${shortCommit(change.commit_before)}..${shortCommit(change.drift ? change.commit_last : change.commit_first)}`);

function changeColumns(nights, format) {
  return [
    {name: 'Number', sort: (c) => c.number.name, className: 'wrap',
      cell: (c) => element('a', {href: numberAddress(c.number)}, c.number.name)},
    {name: 'Change', sort: (c) => changeKind(c.change), cell: (c) => changeBadge(c.change)},
    {name: 'Since', sort: (c) => c.change.first_night, cell: (c) => `${sinceWhen(c.change, nights)}${c.change.drift ? ', drift' : ''}`},
    {name: 'Commits', cell: (c) => betweenCommits(c.change)},
    {name: 'Before → after', number: true, cell: (c) => `${format(c.change.before)} → ${format(c.change.after)} ${c.number.unit}`},
  ];
}

function changeParts({nights, numbers}) {
  const measured = changesOf(numbers.filter((number) => !number.counter));
  const counted = changesOf(numbers.filter((number) => number.counter));
  const columns = [
    ...changeColumns(nights, (x) => formatNumber(x, 4)),
    {name: 'Size', number: true, title: 'With its 95 % interval', sort: (c) => toNumber(c.change.relative),
      cell: ({change}) => `${formatChange(change.relative)} [${formatChange(change.low)} … ${formatChange(change.high)}]`},
    {name: 'Evidence', number: true, sort: (c) => toNumber(c.change.means_p_value),
      title: 'p-values of both detectors: E-divisive means of the nights’ medians; all repetitions before and after, whole nights permuted',
      cell: ({change}) => `p = ${formatNumber(change.means_p_value, 2)} and ${formatNumber(change.distribution_p_value, 2)}`},
  ];
  const exact = (x) => toNumber(x).toLocaleString('en');
  return [
    historyPart('changes', 'Changes', 'Steps and drifts that both detectors found, the latest first. The commits are the last one measured ' +
      'before and the first one after.', measured.length > 0 ? sortableTable(columns, measured) : element('p', {}, 'None.')),
    counted.length > 0 ? historyPart('counters', 'Counters that changed', 'The same at every run of the same code: one night is proof.',
      sortableTable(changeColumns(nights, exact), counted)) : null,
  ];
}

// Parts of the nights

const formatDuration = (seconds) => (seconds >= 120 ? `${Math.round(seconds / 60)} min` : `${formatSeconds(seconds)} s`);

const kPartSigns = {passed: '', failed: '!', 'timed out': '!', skipped: '·'};
const kPartTones = {passed: 'pass', failed: 'wrong', 'timed out': 'wrong', skipped: 'control'};

function partCell(part) {
  if (!part) return element('td', {className: 'none'}, '–');
  const title = `${part.name}: ${part.status}${part.note ? `, ${part.note}` : ''}`;
  const time = part.status === 'skipped' ? 'skipped' : formatDuration(part.seconds);
  return element('td', {title}, element('span', {className: 'night-part'},
    element('i', {className: `cell ${kPartTones[part.status]}`, role: 'img', 'aria-label': part.status}, kPartSigns[part.status]),
    part.status === 'timed out' ? `${time}, ended` : time));
}

function nightRow(night, parts) {
  const by = new Map(night.parts.map((part) => [part.name, part]));
  const seeds = night.gate_runs === 0 ? '–' : countOf(night.gate_runs, 'seed') +
    (night.failing_gate_runs > 0 ? `, ${night.failing_gate_runs} with a failure` : '');
  return element('tr', {},
    element('th', {scope: 'row'}, dayOf(night)),
    element('td', {}, element('code', {}, shortCommit(night.commit)), night.dirty ? ' + local changes' : ''),
    element('td', {className: 'number'}, night.checks.toLocaleString('en')),
    element('td', {className: `number${night.unexpected > 0 ? ' bad-number' : ' none'}`}, String(night.unexpected)),
    element('td', {className: night.failing_gate_runs > 0 ? 'bad-number' : null}, seeds),
    parts.map((name) => partCell(by.get(name))));
}

function nightsTable(nights) {
  const newestFirst = nights.map((night) => ({...night, parts: night.parts ?? []})).reverse();
  const parts = [...new Set(newestFirst.flatMap((night) => night.parts.map((part) => part.name)))];
  const heading = ['Night', 'Commit', 'Checks', 'Unexpected', 'Fresh seeds', ...parts];
  const body = element('tbody');
  const more = element('tfoot');
  const show = (from, to) => {
    body.append(...newestFirst.slice(from, to).map((night) => nightRow(night, parts)));
    const left = newestFirst.length - to;
    more.replaceChildren(...(left > 0 ? [element('tr', {}, element('td', {colspan: heading.length}, element('button', {
      type: 'button', className: 'more-rows', onclick: () => show(to, newestFirst.length),
    }, `${left} more`)))] : []));
  };
  show(0, kNightsAtOnce);
  return scrollBox('Nights', element('table', {className: 'nights'}, element('thead', {}, element('tr', {}, heading.map((text) =>
    element('th', {scope: 'col', className: ['Checks', 'Unexpected'].includes(text) ? 'number' : null}, text)))), body, more));
}

// Seeds

/** A name of a test as a regular expression that ctest takes. */
const quoted = (name) => name.replace(/[\][\\.+*?(){}|^$]/g, '\\$&');

function failingRunCard(run) {
  return element('article', {className: 'card'},
    element('h4', {}, `Seed ${run.seed}`, element('span', {className: 'aside'}, `${run.time.slice(0, 10)} · ${run.commit} · ${countOf(run.tests, 'test')}`)),
    run.failures.map((name) => {
      const command = `PLUMBLINE_NIGHTLY=gate PLUMBLINE_SEED=${run.seed} ctest --preset release -R '^${quoted(name)}$'`;
      return element('div', {className: 'replay'}, element('code', {}, command), copyButton(command));
    }));
}

function seedsPart(record) {
  const {gateRuns, failingRuns} = summariseHistory(record);
  const about = gateRuns === 0 ? 'No night has run the gate with a fresh seed.'
    : `The gate was run ${countOf(gateRuns, 'time')} with seeds that nobody chose; ` +
      `${failingRuns === 0 ? 'no run had a failure' : `${countOf(failingRuns, 'run')} had a failure`}.`;
  return historyPart('seeds', 'Fresh seeds', about, element('div', {}, [...record.failing_gate_runs].reverse().map(failingRunCard)));
}

// The view

function historyContent(record) {
  return [
    historyVerdict(record),
    ...changeParts(record),
    numbersPart(record),
    sequencesPart(record),
    historyPart('nights', 'Nights', 'How the parts of each night went, the latest first.', nightsTable(record.nights)),
    seedsPart(record),
  ];
}

/** How a history comes to be, where these results have none. */
const howToKeepNights = () => [
  element('p', {}, 'These results hold no history of nights. One comes to be where nights are kept in a file:'),
  element('div', {className: 'replay'}, element('code', {}, './run nightly --history FILE'), copyButton('./run nightly --history FILE')),
];

const historyFigures = () => [...data.figures, ...data.tables].filter((item) => item.group === kHistoryFigures);

class HistoryView {
  constructor(records) {
    this.records = records;
    this.shown = element('div');
    this.index = -1;
    this.chooser = element('select', {'aria-label': 'Runs compared', onchange: (event) => this.choose(event.target.selectedIndex)},
      records.map((record) => element('option', {}, `${record.kind}, ${record.machine}`)));
    if (records.length > 0) this.choose(0);
  }

  node() {
    const figures = historyFigures();
    return [
      this.records.length > 1 ? element('div', {className: 'filters'}, this.chooser) : null,
      this.records.length === 0 ? element('div', {}, howToKeepNights()) : this.shown,
      figures.length > 0 ? historyPart('detection', kHistoryFigures, 'Measured by simulation.', figureCards(figures)) : null,
    ];
  }

  choose(index) {
    if (index === this.index) return;
    this.index = index;
    this.chooser.selectedIndex = index;
    this.shown.replaceChildren(...historyContent(this.records[index]).filter(Boolean));
    drawCharts();
  }

  open(section, what, name) {
    if (what === 'number') {
      const has = (record) => record.numbers.some((number) => number.name === name);
      const index = [this.index, ...this.records.keys()].find((i) => this.records[i] && has(this.records[i]));
      if (index === undefined) return;
      this.choose(index);
      this.shown.querySelector('.numbers').showNumber(name);
    } else if (what === 'part') {
      section.querySelector(`[data-part="${CSS.escape(name ?? '')}"]`)?.scrollIntoView();
    }
  }
}

function addHistory() {
  const records = data.history.filter((record) => record.nights.length > 0)
    .sort((a, b) => naturalOrder(b.nights[b.nights.length - 1].time, a.nights[a.nights.length - 1].time));
  let view = null;
  addView({
    id: 'history',
    group: records.length + historyFigures().length > 0 ? 'Over nights' : null,
    title: 'History',
    count: records.length > 0 ? records[0].nights.length : null,
    about: records.length > 0 ? 'Night after night with fresh seeds: what changed, and what all nights prove together.' : '',
    make: () => {
      view = new HistoryView(records);
      return view.node();
    },
    open: (section, [what, name]) => view.open(section, what, name),
  });
}
