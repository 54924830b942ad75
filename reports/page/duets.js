
// What ./run compare-runs found: two revisions that did the same work side by side, their ratio of times, and what was counted.

const kDuetMargin = 0.01;  // as reports/duet_record.h has it: less says nothing
const kLeastDuetSpan = 0.03;  // of the axis on each side of 1: intervals that are narrower look narrow
const kDuetTones = {slower: 'fail wrong', faster: 'pass', 'no change': 'pass', 'identical code': 'pass'};

/** "0123abcd", or with what was not committed. */
const revisionName = (revision) => `${shortCommit(revision)}${revision.endsWith('+') ? ' + local changes' : ''}`;

const slowerDuets = () => data.duets.filter((duet) => duet.verdict === 'slower');

function duetNotices() {
  const slower = slowerDuets();
  return slower.length === 0 ? [] : [element('div', {className: 'notice'},
    element('a', {href: '#duets'}, `${countOf(slower.length, 'part')} slower than before`), `: ${slower.map((duet) => duet.part).join(', ')}`)];
}

/** Words for each counter that is not the same on both sides. */
function countedDifferences({counters_a: before, counters_b: after, results_differ: differ}) {
  const names = [...new Set([...Object.keys(before), ...Object.keys(after)])];
  const words = names.filter((name) => before[name] !== after[name]).map((name) => {
    const [a, b] = [before[name] ?? 0, after[name] ?? 0];
    return `${name.replace('_', ' ')} ${a.toLocaleString('en')} → ${b.toLocaleString('en')}${a > 0 ? ` (${formatChange(b / a - 1)})` : ''}`;
  });
  return [...words, ...(differ ? ['results differ'] : [])];
}

/** Half of the axis of all ratios, as a logarithm. */
const duetSpan = (duets) => 1.05 * Math.max(kLeastDuetSpan, ...duets.filter((duet) => duet.pairs > 0)
  .flatMap(({low, high}) => [Math.abs(Math.log(low)), Math.abs(Math.log(high))]));

/** A ratio with its interval; the band around 1 is what says nothing. */
function duetPicture(duet, span) {
  const x = (ratio) => (50 + (50 * Math.log(ratio)) / span).toFixed(2);
  const band = Math.log1p(kDuetMargin);
  const svg = svgNode('svg', {viewBox: '0 0 100 20', preserveAspectRatio: 'none', class: 'duet', role: 'img', 'aria-label': duetWords(duet)});
  svg.append(svgNode('rect', {class: 'margin', x: (50 - (50 * band) / span).toFixed(2), y: 0, width: ((100 * band) / span).toFixed(2), height: 20}),
    svgNode('path', {class: 'one', d: 'M50 0V20'}),
    svgNode('path', {class: `interval ${duet.verdict === 'slower' ? 'worse' : ''}`, d: `M${x(duet.low)} 10H${x(duet.high)}`}),
    svgNode('path', {class: `ratio ${duet.verdict === 'slower' ? 'worse' : ''}`, d: `M${x(duet.ratio)} 10h0`}));
  return svg;
}

const duetWords = ({ratio, low, high}) => `${ratio.toFixed(4)} [${low.toFixed(4)} … ${high.toFixed(4)}]`;

function duetTable(duets) {
  const span = duetSpan(duets);
  return sortableTable([
    textColumn('Part', (duet) => duet.part, {className: 'wrap'}),
    {name: 'Verdict', sort: (duet) => duet.verdict, cell: (duet) =>
      element('span', {className: `badge ${kDuetTones[duet.verdict] ?? 'inconclusive'}`}, duet.verdict)},
    {name: 'Ratio of times', sort: (duet) => duet.ratio, title: 'Of the second over the first, with its interval; the band is ±1 %',
      cell: (duet) => (duet.pairs > 0 ? duetPicture(duet, span) : '–')},
    {name: 'with its interval', number: true, cell: (duet) => (duet.pairs > 0 ? duetWords(duet) : '–')},
    numberColumn('Pairs', (duet) => duet.pairs, (x) => x.toLocaleString('en')),
    {name: 'Counted', className: 'wrap', cell: (duet) => countedDifferences(duet).join('; ') || 'the same'},
  ], duets);
}

/** What was compared, once for all parts of it. */
function duetComparison(duets) {
  const [{revision_a: before, revision_b: after}] = duets;
  const slower = duets.filter((duet) => duet.verdict === 'slower').length;
  const timed = duets.find((duet) => duet.pairs > 0);
  const said = slower > 0 ? `${countOf(slower, 'part')} of ${duets.length} slower` : `none of ${countOf(duets.length, 'part')} slower`;
  return [
    element('div', {className: `verdict ${slower > 0 ? 'bad' : 'good'}`}, element('div', {},
      element('p', {className: 'verdict-line'}, said),
      element('p', {}, 'From ', element('code', {}, revisionName(before)), ' to ', element('code', {}, revisionName(after)),
        timed ? `; intervals hold with ${formatPercent(1 - duets.length * (1 - timed.confidence))} for all parts together.` : '; no times were taken.'))),
    duetTable(duets),
  ];
}

function addDuets() {
  if (data.duets.length === 0) return;
  const comparisons = groupBy(data.duets, (duet) => `${duet.revision_a} ${duet.revision_b}`);
  addView({
    id: 'duets',
    group: 'Over nights',
    title: 'Duets',
    count: data.duets.length,
    about: 'Two revisions that did the same work side by side, in slices of a millisecond on cores that they exchange. ' +
      'Slower is what is proven to take more than 1 % longer. What can be counted needs one look; a difference there is no failure by itself.',
    make: () => [...comparisons.values()].flatMap(duetComparison),
  });
}
