
// The top of the page, and the order of its sections.

function verdictText({passed, failed_as_expected: caught, inconclusive_as_expected: open, waived, unexpected, unreadable}) {
  const total = passed + caught + open + waived + unexpected;
  if (total === 0) return ['No checks in these results', 'The page shows images and measurements only.'];
  if (unexpected > 0) {
    return [
      `${unexpected} of ${total} checks did not give the verdict they should`,
      'They stand first in the table below, each with its reason and the command that repeats it.',
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

function addOverview(showChecks) {
  const {summary} = data;
  const [title, about] = verdictText(summary);
  const tile = (count, label, tone, kind) =>
    element('button', {type: 'button', className: `tile ${count > 0 ? tone : ''}`, onclick: () => showChecks(kind)},
      element('b', {}, String(count)), element('span', {}, label));
  document.getElementById('overview').append(
    element('div', {className: `verdict ${summary.good ? 'good' : 'bad'}`},
      element('div', {}, element('h2', {}, title), element('p', {}, about)),
      element('div', {className: 'tiles'},
        tile(summary.passed, 'proven', 'pass', 'pass'),
        tile(summary.failed_as_expected, 'controls caught', 'pass', 'fail'),
        tile(summary.inconclusive_as_expected, 'rightly undecided', 'open', 'inconclusive'),
        summary.waived > 0 ? tile(summary.waived, 'waived', 'open', 'waived') : null,
        tile(summary.unexpected, 'unexpected', 'fail', 'unexpected'))));
}

function addNotices() {
  const notices = [];
  if (data.warnings.length > 0) {
    notices.push(element('div', {className: 'notice', role: 'alert'},
      `${data.warnings.length} ${data.warnings.length === 1 ? 'record' : 'records'} could not be read:`,
      element('ul', {}, data.warnings.map((w) =>
        element('li', {}, element('code', {}, w.line > 0 ? `${w.file}:${w.line}` : w.file), ` ${w.what}`)))));
  }
  if (data.environments.length > 1) {
    notices.push(element('div', {className: 'notice'},
      `These results come from ${data.environments.length} different builds or machines:`,
      element('ul', {}, data.environments.map((e) =>
        element('li', {}, `${commitText(e)} · ${e.compiler} · ${e.flags} · ${e.cpu} · ${e.time}`)))));
  }
  document.getElementById('overview').append(...notices);
}

const commitText = (e) => `${e.commit.slice(0, 12)}${e.dirty ? ' + local changes' : ''}`;

function addEnvironment() {
  const environment = data.environments[0];
  if (!environment) return;
  const rows = [
    ['Version', `${environment.version} · ${commitText(environment)}`],
    ['Compiler', `${environment.compiler} · ${environment.flags}`],
    ['Machine', `${environment.cpu} · ${environment.cores} threads · load ${formatNumber(environment.load_average, 2)}`],
    ...Object.entries(environment.libraries),
    ['Started', environment.time.replace('T', ' ').replace('Z', ' UTC')],
  ];
  document.getElementById('environment').append(
    ...rows.flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)]));
}

addEnvironment();
addBars();
const checkTable = addChecks();
addOverview((kind) => {
  checkTable?.showAll(kind);
  document.getElementById('checks')?.scrollIntoView();
});
addNotices();
addImages();
addVarianceRatios();
addCalibration();
addStability();
addCauses();
addSpeed();
addRayCosts();
addVerdictCost();
addFigures();
document.getElementById('overview').after(document.getElementById('contents'));
drawCharts();
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', drawCharts);
