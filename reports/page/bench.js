
// What the benchmarks are held against.

const kBarBadges = {met: 'pass', missed: 'fail wrong', open: 'inconclusive', indicative: 'fail'};

function addBars() {
  const {bars} = data;
  if (bars.length === 0) return;
  const limit = (b) => `${b.at_least ? '≥' : '≤'} ${formatNumber(b.limit, 4)}`;
  const columns = [
    textColumn('Benchmark', (b) => b.name),
    {name: 'Bar', number: true, cell: limit},
    numberColumn('Measured', (b) => b.measured, (x) => formatAligned(x, 4)),
    {name: '95 % interval', number: true, cell: (b) => formatInterval(b.low, b.high, 4)},
    textColumn('Unit', (b) => b.unit),
    {name: 'Verdict', cell: (b) => element('span', {className: `badge ${kBarBadges[b.verdict]}`}, b.verdict)},
    textColumn('To compare', (b) => b.comparison, {className: 'prose'}),
    textColumn('How', (b) => b.note, {className: 'prose'}),
  ];
  addSection('bars', 'Benchmarks against their bars', bars.length,
    'Met or missed: the whole interval lies on one side of the bar. Indicative: measured on less than the bar ' +
    'asks for, as the one-minute benchmarks are; ./run bench --full measures it.', sortableTable(columns, bars));
}
