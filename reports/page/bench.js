
// What the benchmarks are held against.

const kBarBadges = {met: 'pass', missed: 'fail wrong', open: 'inconclusive', indicative: 'fail'};

const barLimit = (bar) => `${bar.at_least ? '≥' : '≤'} ${formatNumber(bar.limit, 4)}`;
const barBadge = (bar) => element('span', {className: `badge ${kBarBadges[bar.verdict]}`}, bar.verdict);

function addBars() {
  const {bars} = data;
  if (bars.length === 0) return;
  const about = (b) => [b.comparison, b.note].filter(Boolean).join(' · ');
  const columns = [
    {
      name: 'Benchmark',
      sort: (b) => b.name,
      cell: (b) => [element('strong', {}, b.name), element('div', {className: 'note'}, about(b))],
    },
    {name: 'Bar', number: true, cell: barLimit},
    numberColumn('Measured', (b) => b.measured, (x) => formatAligned(x, 4)),
    {name: 'Interval', number: true, cell: (b) => formatInterval(b.low, b.high, 4)},
    textColumn('Unit', (b) => b.unit),
    {name: 'Verdict', cell: barBadge},
  ];
  addView({
    id: 'bars',
    group: 'Speed',
    title: 'Bars',
    count: bars.length,
    about: 'Benchmarks against their bars. Met or missed: the whole interval (95 % where no other is named) lies on one ' +
      'side of the bar; open: the bar is inside. Indicative: measured on less than the bar asks for, as the one-minute ' +
      'benchmarks are; ./run bench --full measures it.',
    make: () => [sortableTable(columns, bars)],
  });
}

// What verdicts cost

function addVerdictCost() {
  const checks = data.checks.filter((c) => toNumber(c.seconds) > 0);
  if (checks.length === 0) return;
  addView({
    id: 'verdict-cost',
    group: 'Speed',
    title: 'Cost of a verdict',
    about: 'Time and samples that the checks took, by kind, and the ten dearest of them.',
    make: () => [verdictCost(checks)],
  });
}

function verdictCost(checks) {
  const sum = (list, get) => list.reduce((total, c) => total + toNumber(get(c)), 0);
  const kinds = [...groupBy(checks, (c) => c.check)].map(([kind, list]) => {
    const times = list.map((c) => toNumber(c.seconds)).sort((a, b) => a - b);
    return {
      kind,
      count: list.length,
      seconds: sum(list, (c) => c.seconds),
      median: times[Math.floor(times.length / 2)],
      samples: sum(list, (c) => c.samples),
    };
  }).sort((a, b) => b.seconds - a.seconds);
  const kindColumns = [
    textColumn('Kind of check', (k) => k.kind),
    numberColumn('Checks', (k) => k.count, String),
    numberColumn('Seconds', (k) => k.seconds, formatSeconds),
    numberColumn('Seconds per check', (k) => k.seconds / k.count, formatSeconds),
    numberColumn('Median', (k) => k.median, formatSeconds),
    numberColumn('Samples', (k) => k.samples, formatCount),
    numberColumn('Samples per check', (k) => Math.round(k.samples / k.count), formatCount),
  ];
  const dearest = [...checks].sort((a, b) => toNumber(b.seconds) - toNumber(a.seconds)).slice(0, 10);
  const checkColumns = [
    textColumn('Check', (c) => c.check),
    textColumn('Subject', (c) => c.subject),
    {name: 'Verdict', cell: verdictBadge},
    numberColumn('Seconds', (c) => c.seconds, formatSeconds),
    numberColumn('Samples', (c) => c.samples, formatCount),
    numberColumn('ns per sample', (c) => (c.samples > 0 ? (1e9 * toNumber(c.seconds)) / c.samples : NaN), (x) => formatAligned(x, 3)),
  ];
  const card = (title, table) => element('div', {className: 'card'}, element('h3', {}, title), table);
  return element('div', {}, card('By kind', sortableTable(kindColumns, kinds)),
    card('The ten dearest', sortableTable(checkColumns, dearest)));
}
