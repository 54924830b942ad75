
// One check in full: what was found, where, why, and the command that repeats it.

/** Both ways between checks and their addresses; of several checks with one name the later ones get a number. */
let checkNames = null;

function nameChecks() {
  const names = {addresses: new Map(), checks: new Map()};
  for (const check of data.checks) {
    const address = addressOf('check', check.check, check.subject);
    let unique = address;
    for (let n = 2; names.checks.has(unique); ++n) unique = `${address}/${n}`;
    names.checks.set(unique, check);
    names.addresses.set(check, unique);
  }
  return names;
}

function checkAddress(check) {
  checkNames ??= nameChecks();
  return checkNames.addresses.get(check);
}

function checkAt(address) {
  checkNames ??= nameChecks();
  return checkNames.checks.get(address);
}

function fact(name, value) {
  return value === '–' || value === '' ? null : element('div', {}, element('dt', {}, name), element('dd', {}, value));
}

function copyButton(text) {
  const button = element('button', {
    type: 'button',
    className: 'copy',
    onclick: async () => {
      try {
        await navigator.clipboard.writeText(text);
        button.textContent = 'Copied';
      } catch {
        getSelection().selectAllChildren(button.previousSibling);
        button.textContent = 'Selected';
      }
    },
  }, 'Copy');
  return button;
}

/** The interval and the estimate on one axis with the tolerance around the reference, where a check has these. */
function toleranceBand(check) {
  const [low, high, estimate, reference, tolerance] =
    [check.interval_low, check.interval_high, check.estimate, check.reference, check.tolerance].map(toNumber);
  const ends = [low, high, estimate, reference - tolerance, reference + tolerance];
  if (!ends.every(Number.isFinite) || !(tolerance > 0)) return null;
  const middle = (Math.min(...ends) + Math.max(...ends)) / 2;
  const span = 1.2 * (Math.max(...ends) - Math.min(...ends));
  const at = (x) => 50 + (100 * (x - middle)) / span;
  const range = (a, b) => `left:${at(a)}%;width:${at(b) - at(a)}%`;
  return element('figure', {className: 'band'},
    element('div', {className: 'band-axis'},
      element('i', {className: 'allowed', style: range(reference - tolerance, reference + tolerance)}),
      element('i', {className: 'known', style: `left:${at(reference)}%`}),
      element('b', {style: range(low, high)}),
      element('u', {style: `left:${at(estimate)}%`})),
    element('figcaption', {}, 'Dot: estimate; bar: 99.9 % interval; line: known answer; shaded: tolerance'));
}

function checkFacts(check) {
  return element('dl', {className: 'facts'},
    fact('Estimate', formatNumber(check.estimate, 6)),
    fact('Reference', formatNumber(check.reference, 6)),
    fact('99.9 % interval', formatInterval(check.interval_low, check.interval_high, 6)),
    fact('Tolerance', formatNumber(check.tolerance, 4)),
    fact('Proven bound', formatNumber(check.bound, 4)),
    fact('Detectable', formatNumber(check.detectable, 4)),
    fact('p-value', formatNumber(check.p_value, 3)),
    fact('Samples', check.samples.toLocaleString('en')),
    fact('Seconds', formatSeconds(check.seconds)),
    fact('Leaned on', check.leaned_on),
    fact('Seed', check.seed),
    check.figures.map(([name, value]) => fact(name, formatNumber(value, 6))));
}

/** What a reader wants to know of a check, below its name. */
function checkReport(check) {
  const why = check.reason || (check.as_expected ? '' : `Expected ${check.expected}, got ${check.verdict}.`);
  return [
    why ? element('p', {className: 'why'}, why) : null,
    check.advice ? element('p', {className: 'why'}, check.advice) : null,
    check.waived ? element('p', {className: 'why'}, `Waived: ${check.waived}`) : null,
    check.diagnosis ? element('p', {className: 'diagnosis'}, element('b', {}, 'Diagnosis '), check.diagnosis) : null,
    toleranceBand(check),
    check.bins ? binMaps(check.bins) : null,
    checkFacts(check),
    check.replay
      ? element('div', {className: 'replay'}, element('code', {}, check.replay), copyButton(check.replay))
      : null,
  ];
}

/** The report of a check with its name, which links to it. */
function checkCard(check) {
  return element('article', {className: `card check-card${check.as_expected ? '' : ' unexpected'}`},
    element('h3', {}, element('a', {href: checkAddress(check)}, check.subject), element('span', {className: 'aside'}, check.check),
      verdictBadge(check), element('span', {className: 'aside'}, `expected ${check.expected}`)),
    checkReport(check));
}

function showCheck(section, rest) {
  const check = checkAt(addressOf('check', ...rest));
  section.querySelector('.shown').replaceChildren(check
    ? checkCard(check)
    : element('p', {}, 'There is no such check in these results.'));
}

function addCheckView() {
  addView({
    id: 'check',
    title: 'Check',
    make: () => [element('p', {className: 'back'}, element('a', {href: '#checks'}, 'All checks')), element('div', {className: 'shown'})],
    open: showCheck,
  });
}
