
// Scenes: their pictures, and where the answer is known what was proven of it.

const kProvesAnswers = ['mean', 'image', 'agreement'];

/** Checks of a scene by its name, the first part of their subjects. */
let answersOf = null;

function answersByScene() {
  const scenes = new Set(data.images.map((image) => image.group));
  const answers = data.checks.filter((c) => kProvesAnswers.includes(c.check) && scenes.has(suiteOf(c)));
  return groupBy(answers, suiteOf);
}

function answerTable(checks) {
  const columns = [
    {name: 'How', sort: nameInSuite, cell: (c) => element('a', {href: checkAddress(c)}, nameInSuite(c))},
    numberColumn('Answer', (c) => c.reference, (x) => formatAligned(x)),
    numberColumn('Estimate', (c) => c.estimate, (x) => formatAligned(x)),
    {name: 'Proven bound', number: true, cell: (c) => relativeToReference(c, c.bound)},
    {name: 'Verdict', sort: (c) => c.verdict, cell: verdictBadge},
    {name: '99.9 % interval', number: true, cell: (c) => formatInterval(c.interval_low, c.interval_high, 5)},
  ];
  return sortableTable(columns, checks);
}

function sceneCard(name, images, checks) {
  return element('article', {className: 'card scene'},
    element('h3', {}, nameOf(name), element('code', {className: 'aside'}, name)),
    data.answers[sceneOf(name)] ? element('p', {className: 'formula mono'}, data.answers[sceneOf(name)]) : null,
    element('div', {className: 'scene-parts'},
      new Comparison(name, images).node(),
      checks.length > 0 ? answerTable(checks) : null));
}

function scenePlace(name, images) {
  const checks = answersOf.get(name) ?? [];
  return element('div', {'data-scene': name, className: checks.length > 0 ? 'answered' : null},
    whenNear(() => sceneCard(name, images, checks), 'to-come'));
}

/** Groups with something to compare stand first: they say most. */
function sortedScenes() {
  return [...groupBy(data.images, (image) => image.group)]
    .sort((a, b) => (b[1].length > 1) - (a[1].length > 1) || naturalOrder(a[0], b[0]));
}

function addImages() {
  if (data.images.length === 0 && data.renders.length === 0) return;
  addView({
    id: 'images',
    group: 'Pictures',
    title: 'Known answers',
    count: sortedScenes().length,
    about: 'Scenes rendered with equal samples, linear values. Where the answer is known, every way to render has ' +
      'proven how far its mean may be from it.',
    make: () => {
      answersOf ??= answersByScene();
      return [element('div', {className: 'scenes'}, sortedScenes().map(([name, images]) => scenePlace(name, images)))];
    },
    open: (section, [name]) => {
      if (name) section.querySelector(`[data-scene="${CSS.escape(name)}"]`)?.scrollIntoView();
    },
  });
  if (!data.renders.some((r) => r.camera_rays > 0)) return;
  addView({
    id: 'renders',
    group: 'Pictures',
    title: 'Render log',
    count: data.renders.length,
    about: 'What each rendering did.',
    make: () => [renderTable()],
  });
}
