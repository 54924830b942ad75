
// How good estimators are against each other, and the checks against what they claim.

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
  addView({
    id: 'variance',
    group: 'Quality',
    title: 'Variance ratios',
    count: ratios.length,
    about: 'Variance of the first estimator over that of the second, equal samples. At 1 they are equally good; ' +
      'an interval that does not touch 1 is a difference.',
    make: () => [sortableTable(columns, ratios)],
  });
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
    textColumn('Case', (c) => c.subject.split('/').slice(2).join('/')),
    numberColumn('Runs', (c) => c.samples, formatCount),
    numberColumn('Measured', (c) => c.estimate, (x) => formatNumber(x, 4)),
    {name: '99.9 % interval', number: true, cell: (c) => formatInterval(c.interval_low, c.interval_high)},
    {name: 'Must lie in', number: true, cell: (c) => formatInterval(figure(c, 'at least'), figure(c, 'at most'))},
    {name: 'Verdict', sort: (c) => c.verdict, cell: verdictBadge},
  ];
  const tables = () => [...groupBy(rows, (c) => part(c, 1))].flatMap(([name, group]) => [
    element('h3', {}, name),
    element('p', {className: 'muted'}, calibrationTables[name] ?? ''),
    sortableTable(columns, group),
  ]);
  addView({
    id: 'calibration',
    group: 'Quality',
    title: 'Calibration and power',
    count: rows.length,
    about: 'The checks on code whose answer is known: how often they fail what is right, and how often they find what is ' +
      'wrong. A pass proves that the true rate lies in the range; controls, tests known to be badly calibrated, must fail.',
    make: tables,
  });
}
