
// Numbers and proofs over nights. Plots of numbers are small, many and alike: drawn as shapes that take the page's
// colours, each when it comes near the window.

const kLeastSpan = 0.02;  // of a plot's axis, relative to the number: less is noise, and is shown as such
const kSequencesShown = 100;
const kSequencesTicked = 4;

/** Runs of nights that have a value: lists of places. */
function stretchesOf(values) {
  const stretches = [];
  values.forEach((value, night) => {
    if (!Number.isFinite(value)) return;
    const last = stretches[stretches.length - 1];
    if (last && last[last.length - 1] === night - 1) last.push(night);
    else stretches.push([night]);
  });
  return stretches;
}

/** Ends of the axis: all that is drawn, with a margin, and at least `span` of the middle, so that noise does not fill it. */
function rangeOf(values, span) {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  const middle = (low + high) / 2;
  const half = Math.max(0.55 * (high - low), (span / 2) * Math.abs(middle)) || 1;
  return {low: middle - half, high: middle + half};
}

const pathOf = (points) => points.map(([x, y], i) => `${i === 0 ? 'M' : 'L'}${x} ${y.toFixed(2)}`).join('');

/** The picture of a number: one unit to the night across, 100 units down. */
function numberShapes(number) {
  const [median, low, high] = [number.median, number.low, number.high].map((list) => list.map(toNumber));
  const range = rangeOf([...median, ...low, ...high], number.counter && number.changes.length > 0 ? 0 : kLeastSpan);
  const y = (value) => (100 * (range.high - value)) / (range.high - range.low);
  const svg = svgNode('svg', {viewBox: `-0.7 0 ${median.length + 0.4} 100`, preserveAspectRatio: 'none', 'aria-hidden': 'true'});
  const add = (className, d) => { if (d) svg.append(svgNode('path', {class: className, d})); };
  for (const {regression, drift, first_night: first, last_night: last} of number.changes) {
    const tone = regression ? 'worse' : 'better';
    if (drift) svg.append(svgNode('rect', {class: `drift ${tone}`, x: first - 0.5, y: 0, width: last - first + 1, height: 100}));
    add(`step ${tone}`, `M${first - 0.5} 0V100`);
  }
  const stretches = stretchesOf(median);
  const spread = stretchesOf(median.map((_, i) => low[i] + high[i]));
  add('spread', spread.map((s) => `${pathOf([...s.map((i) => [i, y(high[i])]), ...s.reverse().map((i) => [i, y(low[i])])])}Z`).join(''));
  add('median', stretches.filter((s) => s.length > 1).map((s) => pathOf(s.map((i) => [i, y(median[i])]))).join(''));
  add('alone', stretches.filter((s) => s.length === 1).map(([i]) => `M${i} ${y(median[i]).toFixed(2)}h0`).join(''));
  add('odd', number.odd_nights.filter((i) => Number.isFinite(median[i])).map((i) => `M${i} ${y(median[i]).toFixed(2)}h0`).join(''));
  return {svg, range};
}

function describeNight(number, night, place) {
  const value = toNumber(number.median[place]);
  const when = `${dayOf(night)} · ${shortCommit(night.commit)}`;
  if (Number.isNaN(value)) return `${when}: not measured`;
  if (number.counter) return `${when}: ${value.toLocaleString('en')} ${number.unit}`;
  const odd = number.odd_nights.includes(place) ? ', left out' : '';
  return `${when}: ${formatNumber(value, 4)} ${number.unit} [${formatInterval(number.low[place], number.high[place])}]${odd}`;
}

function lastMeasured(number) {
  for (let night = number.median.length - 1; night >= 0; --night) {
    if (Number.isFinite(toNumber(number.median[night]))) return night;
  }
  return -1;
}

function numberLabel(number, nights) {
  const changes = number.changes.map((c) => `${changeKind(c)} of ${formatChange(c.relative)} since ${dayOf(nights[c.first_night])}`);
  return `${number.name} over ${countOf(nights.length, 'night')}${changes.length > 0 ? `: ${changes.join(', ')}` : ', no change'}`;
}

/** The plot of one number with its latest value; pointing at a night, or an arrow up or down, reads it. */
function numberCard(number, nights) {
  const {svg, range} = numberShapes(number);
  const latest = lastMeasured(number);
  let place = latest;
  const reading = element('p', {className: 'reading', role: 'status'});
  const pointer = svgNode('path', {class: 'pointer', d: ''});
  svg.append(pointer);
  const read = (to) => {
    place = Math.max(0, Math.min(nights.length - 1, to));
    pointer.setAttribute('d', `M${place} 0V100`);
    reading.textContent = describeNight(number, nights[place], place);
  };
  const rest = () => {
    pointer.setAttribute('d', '');
    reading.textContent = latest < 0 ? 'never measured' : describeNight(number, nights[latest], latest);
  };
  const frame = element('div', {
    className: 'night-frame', role: 'img', tabindex: 0, 'aria-label': numberLabel(number, nights),
    onpointermove: (event) => {
      const box = svg.getBoundingClientRect();
      read(Math.floor(((event.clientX - box.left) / box.width) * nights.length));
    },
    onpointerleave: rest,
    onblur: rest,
    onkeydown: (event) => {
      const step = {ArrowUp: 1, ArrowDown: -1}[event.key];
      if (!step) return;
      event.preventDefault();
      read(place + step);
    },
  }, svg);
  rest();
  const formatEnd = (x) => (number.counter ? Math.round(x).toLocaleString('en') : formatNumber(x, 3));
  const badges = [...new Map(number.changes.map((c) => [changeKind(c), c])).values()].map(changeBadge);
  return element('article', {className: 'card night-card'},
    element('h4', {}, element('a', {href: numberAddress(number)}, number.name), ...badges),
    element('div', {className: 'night-plot'},
      element('div', {className: 'night-scale'}, element('span', {}, formatEnd(range.high)), element('span', {}, number.unit),
        element('span', {}, formatEnd(range.low))),
      frame,
      element('div', {className: 'night-days'}, element('span', {}, dayOf(nights[0])), element('span', {}, dayOf(nights[nights.length - 1])))),
    reading);
}

const kNumberKinds = {
  All: () => true,
  Changed: (number) => number.changes.length > 0,
  Measured: (number) => !number.counter,
  Counted: (number) => number.counter,
};

class NumberPlots {
  constructor({numbers, nights}) {
    this.nights = nights;
    // What changed last stands first.
    const lastChange = (number) => Math.max(-1, ...number.changes.map((change) => change.last_night));
    this.numbers = [...numbers].sort((a, b) => lastChange(b) - lastChange(a) || naturalOrder(a.name, b.name));
    this.kind = 'All';
    this.words = [];
    this.places = new Map(this.numbers.map((number) =>
      [number, element('div', {className: 'night-place'}, whenNear(() => numberCard(number, nights)))]));
    this.grid = element('div', {className: 'numbers'});
    this.grid.showNumber = (name) => this.showNumber(name);
    this.count = element('span', {className: 'count', role: 'status'});
    this.search = element('input', {
      type: 'search', placeholder: 'Filter by words', 'aria-label': 'Filter numbers',
      oninput: (event) => this.filter(event.target.value),
    });
    this.chips = Object.keys(kNumberKinds).map((kind) =>
      element('button', {type: 'button', onclick: () => this.show(kind)}, kind));
    this.draw();
  }

  node() {
    return [element('div', {className: 'filters'}, this.search,
      element('div', {className: 'chips', role: 'group', 'aria-label': 'Kinds of numbers'}, this.chips), this.count), this.grid];
  }

  filter(text) {
    this.words = text.toLowerCase().split(/\s+/).filter(Boolean);
    this.draw();
  }

  show(kind) {
    this.kind = kind;
    this.draw();
  }

  draw() {
    this.chips.forEach((chip) => chip.setAttribute('aria-pressed', String(chip.textContent === this.kind)));
    const shown = this.numbers.filter((number) => kNumberKinds[this.kind](number) &&
      this.words.every((word) => `${number.name} ${number.unit}`.toLowerCase().includes(word)));
    this.count.textContent = shown.length === this.numbers.length
      ? countOf(shown.length, 'number') : `${shown.length} of ${countOf(this.numbers.length, 'number')}`;
    this.grid.replaceChildren(...shown.map((number) => this.places.get(number)));
  }

  /** Brings a number into the window, whatever the filter was. */
  showNumber(name) {
    const number = this.numbers.find((n) => n.name === name);
    if (!this.places.get(number).isConnected) {
      this.search.value = '';
      this.words = [];
      this.show('All');
    }
    for (const place of this.places.values()) place.classList.toggle('pointed', place === this.places.get(number));
    this.places.get(number).scrollIntoView({block: 'center'});
  }
}

function numbersPart(record) {
  if (record.numbers.length === 0) return null;
  return historyPart('numbers', 'Tracked numbers', 'Median of each night and its quartiles; a vertical line is a change, a shaded stretch a ' +
    'drift, a thick dot a night that was left out as an outlier, a gap a night without a measurement.', new NumberPlots(record).node());
}

// Sequences

/** What is proven after each night as a share of what the check tolerates. */
const sharesOf = ({bound, tolerance}) => bound.map((b) => toNumber(b) / toNumber(tolerance));

function lastOf(values) {
  for (let i = values.length - 1; i >= 0; --i) if (!Number.isNaN(toNumber(values[i]))) return toNumber(values[i]);
  return NaN;
}

/** Over all sequences, the k-th of n parts of what a night's sequences have proven. */
function sharesByNight(sequences, nights) {
  const shares = sequences.map(sharesOf);
  return nights.map((_, night) => shares.map((list) => list[night]).filter((x) => x > 0 && Number.isFinite(x)).sort((a, b) => a - b));
}

const nightLabel = (night, place) => `${dayOf(night)} (night ${place + 1})`;

function sequenceDatasets(sequences, nights, ticked) {
  const sorted = sharesByNight(sequences, nights);
  const line = (label, color, ys, more = {}) => ({
    label, curve: label, borderColor: cssColor(color), backgroundColor: cssColor(color), showLine: true, pointRadius: 0, pointStyle: 'line',
    borderWidth: 2, spanGaps: false, data: ys.map((y, i) => ({x: i + 1, y, note: `  ${nightLabel(nights[i], i)}`})), ...more,
  });
  const of = (get) => sorted.map((values) => (values.length > 0 ? get(values) : NaN));
  return [
    line('largest', 'bsdf', of((v) => v[v.length - 1]), {borderDash: [6, 4]}),
    line('median of all', 'ink', of((v) => v[Math.floor(v.length / 2)])),
    line('smallest', 'mis', of((v) => v[0]), {borderDash: [6, 4]}),
    line('tolerance', 'fail', nights.map(() => 1), {borderWidth: 1, borderDash: [2, 3]}),
    ...[...ticked].map((s, i) => line(s.subject, kOthers[i % kOthers.length], sharesOf(s).map((x) => (x > 0 ? x : NaN)),
      {pointRadius: 2, pointStyle: kMarkers[i % kMarkers.length], borderWidth: 1})),
  ];
}

const sequenceBadge = (s) =>
  element('span', {className: `badge ${s.verdict}${s.verdict === 'fail' ? ' wrong' : ''}`}, s.verdict);

function sequenceColumns(ticked, redraw) {
  const box = (s) => element('input', {
    type: 'checkbox', checked: ticked.has(s), disabled: s.tolerance === null,
    onchange: (event) => {
      if (event.target.checked) ticked.add(s);
      else ticked.delete(s);
      redraw();
    },
  });
  return [
    {name: 'Check', sort: (s) => s.subject, className: 'wrap',
      cell: (s) => [element('label', {}, box(s), s.subject), s.reason ? element('div', {className: 'note'}, s.reason) : null]},
    textColumn('Kind', (s) => s.check),
    {name: 'Verdict', sort: (s) => s.verdict, cell: sequenceBadge},
    numberColumn('Nights', (s) => s.nights, String, {title: 'Since it began, with the same code'}),
    numberColumn('Bound', (s) => lastOf(s.bound), (x) => formatNumber(x, 3), {title: 'What is proven of |bias|, of a difference, or of the distance of a share or the logarithm of a ratio from the middle of its claim'}),
    numberColumn('of tolerance', (s) => lastOf(s.bound) / toNumber(s.tolerance), formatPercent),
    numberColumn('Evidence', (s) => Math.exp(lastOf(s.evidence)), (x) => formatNumber(x, 3),
      {title: 'Against what a test says, by all nights: that it is at least this large has a chance of one over it at most'}),
  ];
}

/** What failed stands first, then what has proven least. */
function sequencesInOrder(sequences) {
  const share = (s) => lastOf(s.bound) / toNumber(s.tolerance);
  const key = new Map(sequences.map((s) => [s, share(s)]));
  return [...sequences].sort((a, b) => (b.verdict === 'fail') - (a.verdict === 'fail') || compareValues(key.get(a), key.get(b), -1));
}

function sequencesPart({sequences, nights}) {
  if (sequences.length === 0) return null;
  const bounded = sequences.filter((s) => s.tolerance !== null);
  const order = sequencesInOrder(sequences);
  const ticked = new Set(order.filter((s) => s.tolerance !== null).slice(0, kSequencesTicked));
  let draw = () => {};
  const columns = sequenceColumns(ticked, () => draw());
  const table = element('div', {className: 'sequence-table'});
  const count = element('span', {className: 'count', role: 'status'});
  const show = (text) => {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    const found = order.filter((s) => words.every((word) => `${s.subject} ${s.check} ${s.verdict}`.toLowerCase().includes(word)));
    count.textContent = `${Math.min(found.length, kSequencesShown)} of ${countOf(sequences.length, 'check')}`;
    table.replaceChildren(sortableTable(columns, found.slice(0, kSequencesShown)));
  };
  show('');
  const picture = bounded.length > 0 ? plot(() => sequenceDatasets(bounded, nights, ticked), {label: 'night', log: false},
    {label: 'bound / tolerance', log: true}, 'Proven bounds over nights', {redraw: (f) => { draw = f; }}) : null;
  return historyPart('sequences', 'Proven by all nights together', 'Checks that go on from night to night: the proven bound on each bias ' +
    'shrinks, until the code changes and it begins again. What failed stands first, then what has proven least.',
  element('div', {className: 'card'},
    picture,
    element('div', {className: 'filters'}, element('input', {
      type: 'search', placeholder: 'Filter by words', 'aria-label': 'Filter checks over nights', oninput: (event) => show(event.target.value),
    }), count),
    table));
}
