
// The first view: the verdict, what needs a person's eyes, the bars, and what this is about in two pictures.

function verdictText({passed, failed_as_expected: caught, inconclusive_as_expected: open, waived, unexpected, unreadable}) {
  const total = passed + caught + open + waived + unexpected;
  if (total === 0) return ['No checks in these results', 'The page shows images and measurements only.'];
  if (unexpected > 0) {
    return [
      `${unexpected} of ${total} checks did not give the verdict they should`,
      'They stand below in full, each with its reason and the command that repeats it.',
    ];
  }
  if (unreadable > 0) {
    return [`${total} checks as expected, but results were lost`, 'What could not be read may have held a failure.'];
  }
  if (waived > 0) {
    return [
      `${total - waived} of ${total} checks gave the verdict they should, ${waived} ${waived === 1 ? 'is' : 'are'} waived`,
      'A waiver names a known failure, with its reason and its last day.',
    ];
  }
  return [
    `All ${total} checks gave the verdict they should`,
    'A pass is a proven bound, not a test that found nothing; negative controls must fail, and do.',
  ];
}

function verdictPanel() {
  const {summary} = data;
  const [title, about] = verdictText(summary);
  const tile = (count, label, tone, kind) =>
    element('a', {className: `tile ${count > 0 ? tone : ''}`, href: addressOf('checks', kind)},
      element('b', {}, count.toLocaleString('en')), element('span', {}, label));
  return element('div', {className: `verdict ${summary.good ? 'good' : 'bad'}`},
    element('div', {}, element('p', {className: 'verdict-line'}, title), element('p', {}, about)),
    element('div', {className: 'tiles'},
      tile(summary.passed, 'proven', 'pass', 'pass'),
      tile(summary.failed_as_expected, 'controls caught', 'pass', 'fail'),
      tile(summary.inconclusive_as_expected, 'rightly undecided', 'open', 'inconclusive'),
      summary.waived > 0 ? tile(summary.waived, 'waived', 'open', 'waived') : null,
      tile(summary.unexpected, 'unexpected', 'fail', 'unexpected')));
}

function notices() {
  const found = [];
  if (data.warnings.length > 0) {
    found.push(element('div', {className: 'notice', role: 'alert'},
      `${data.warnings.length} ${data.warnings.length === 1 ? 'record' : 'records'} could not be read:`,
      element('ul', {}, data.warnings.map((w) =>
        element('li', {}, element('code', {}, w.line > 0 ? `${w.file}:${w.line}` : w.file), ` ${w.what}`)))));
  }
  if (data.environments.length > 1) {
    found.push(element('div', {className: 'notice'},
      `These results come from ${data.environments.length} different builds or machines:`,
      element('ul', {}, data.environments.map((e) =>
        element('li', {}, `${commitText(e)} · ${e.compiler} · ${e.flags} · ${e.cpu} · ${e.time}`)))));
  }
  return found;
}

/** Checks that are shown in full before the first click; the others are one click away. */
const kShownInFull = 10;

function needsEyes() {
  const wrong = data.checks.filter((check) => !check.as_expected);
  if (wrong.length === 0) return [];
  const left = wrong.length - kShownInFull;
  return [
    element('h3', {className: 'part'}, 'What needs your eyes'),
    ...wrong.slice(0, kShownInFull).map(checkCard),
    left > 0 ? element('p', {}, element('a', {href: '#checks/unexpected'}, `and ${left} more`)) : null,
  ];
}

function barList() {
  if (data.bars.length === 0) return [];
  const order = ['missed', 'open', 'met', 'indicative'];
  const bars = [...data.bars].sort((a, b) => order.indexOf(a.verdict) - order.indexOf(b.verdict));
  const columns = [
    textColumn('Benchmark', (b) => b.name, {className: 'wrap'}),
    {name: 'Bar', number: true, cell: barLimit},
    numberColumn('Measured', (b) => b.measured, (x) => formatAligned(x, 4)),
    textColumn('Unit', (b) => b.unit, {className: 'wide-only'}),
    {name: 'Verdict', cell: barBadge},
  ];
  return [
    element('h3', {className: 'part'}, 'Bars met and missed ', element('a', {className: 'aside', href: '#bars'}, 'with intervals')),
    sortableTable(columns, bars),
  ];
}

/** What this project is about, in two scenes of the literature that need more than one technique. */
const kShowpieces = {
  veach: 'BSDF samples find the large lights in the smooth plates, light samples the small ones in the ' +
    'rough. MIS weighs each by its density and has the noise of neither.',
  cornell: 'BSDF samples seldom meet the lamp, light samples aim at it. Both have the same mean; what ' +
    'differs is the noise at equal samples.',
};

function showpieces() {
  const cards = Object.entries(kShowpieces).flatMap(([name, about]) => {
    const images = data.images.filter((image) => sceneOf(image.group) === name);
    return images.length === 0 ? [] : [element('article', {className: 'card showpiece'},
      element('h3', {}, nameOf(name)), element('p', {className: 'caption'}, about), new Comparison(name, images).node())];
  });
  return cards.length === 0 ? [] : [element('h3', {className: 'part'}, 'What this is about'),
    element('div', {className: 'showpieces'}, cards)];
}

const commitText = (e) => `${e.commit.slice(0, 12)}${e.dirty ? ' + local changes' : ''}`;

function environmentList() {
  const environment = data.environments[0];
  if (!environment) return [];
  const rows = [
    ['Version', `${environment.version} · ${commitText(environment)}`],
    ['Compiler', `${environment.compiler} · ${environment.flags}`],
    ['Machine', `${environment.cpu} · ${environment.cores} threads · load ${formatNumber(environment.load_average, 2)}`],
    ...Object.entries(environment.libraries),
    ['Started', environment.time.replace('T', ' ').replace('Z', ' UTC')],
  ];
  return [element('h3', {className: 'part'}, 'This run'),
    element('dl', {className: 'environment'}, rows.flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)]))];
}

function addOverview() {
  addView({
    id: 'overview',
    group: 'Verdict',
    title: 'Overview',
    make: () => {
      const missed = data.bars.some((bar) => bar.verdict === 'missed');  // then the bars need eyes too
      const rest = missed ? [barList(), showpieces()] : [showpieces(), barList()];
      return [verdictPanel(), ...notices(), ...historyNotices(), ...duetNotices(), ...needsEyes(), ...rest.flat(), ...environmentList()];
    },
  });
}
