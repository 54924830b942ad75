
// What the subjects of checks are: the one place that reads their names.

/** What a scene of the literature is called. */
const kSceneNames = {veach: 'Veach’s plates', veach_phong: 'Veach’s plates, Phong lobes', cornell: 'Cornell box'};

/** A scene by its name alone, whether it was one that the command knows or a file. */
const sceneOf = (group) => group.replace(/^(?:.*\/)?([^/]+)\.xml$/, '$1');

const capitalised = (word) => word.charAt(0).toUpperCase() + word.slice(1);

/** Names in one style: "GgxConductor" → "GGX conductor", "furnace_sphere" → "Furnace sphere". */
function nameOf(name) {
  const scene = sceneOf(name);
  if (kSceneNames[scene]) return kSceneNames[scene];
  const words = scene.replaceAll('_', ' ').replace(/([a-z])([A-Z])/g, (_, a, b) => `${a} ${b.toLowerCase()}`);
  const sentence = words.replace(/^ggx\b/i, 'GGX').replace(/^mis\b/, 'MIS').replace(/\b(phong|gaussian)\b/, capitalised);
  return capitalised(sentence);
}

/** Kinds of things by the first part of a subject, in the order of the matrix; the first rule that fits holds. */
const kKinds = [
  ['BSDFs', /^([A-Z][a-z0-9]+)+$/],
  ['Lights', /^(light|light selection|overlapping lights|direct light|environment map.*|sun and sky|sun not hit.*|BSDF samples beside.*)$/],
  ['Warps and distributions', /^(warp|discrete distribution)$/],
  ['Integrals and MIS weights', /^(combinations|optimal weights|mirror and lamp|rejecting technique|bad_gaussian.*|broad_times_peaked|peaked_times_peaked|sun_and_sidewalk|three_peaks|two_steps)$/],
  ['Samplers', /^(sobol|independent|correlation of pixels|nets .*|rendered nets|padded pairs|neighbouring .*|x y over.*)$/],
  ['Scene parameters', /^off default$/],
  ['The checks themselves', /^(mean|ratio|proportion|agreement|calibration|budget|waiver|bug|again|invariance|contribution weights|stochastic|correct)$/],
  ['Rays and paths', /^(paths after.*|variance of images.*)$/],
  ['Scenes', /^([a-z0-9]+|[a-z0-9]+(_[a-z0-9]+)+( .*)?)$/],
  ['Others', /^/],
];
const kControls = 'Negative controls';

/** Checks of points that depend on each other are about samplers, whatever the points are called. */
const kSamplerChecks = ['strata', 'net', 'replicates'];

const kindOf = (first, check) =>
  (kSamplerChecks.includes(check) ? 'Samplers' : kKinds.find(([, rule]) => rule.test(first))[0]);

/** What tells checks of one cell apart, not cells: angles, lobes, channels, the type of number. */
function rowPart(part) {
  if (/^(red|green|blue|float|lobe \d+|albedo at [\d.]+)$/.test(part)) return '';
  return part.replace(/^(front|back) [\d.]+°?$/, '$1');
}

/**
 * Where a check stands in the matrix: a kind of thing, one thing of that kind, and what was varied of it.
 * @param subject   "GgxConductor/alpha 1/back 60°/integral"
 * @param check     "integral", which a subject may repeat at its end
 * @param expected  the verdict that is right: what must fail is a negative control
 * @return          {kind: 'BSDFs', thing: 'GGX conductor', row: 'alpha 1 · back'}
 */
function placeOf({subject, check, expected}) {
  const parts = subject.split(/(?<!\d)\/|\/(?!\d|pi\b)/);  // but not in "eta 1/1.5" and "without 1/pi"
  if (parts.length > 1 && parts[parts.length - 1] === check) parts.pop();
  const control = expected === 'fail' || parts[0] === 'control';
  if (parts[0] === 'control') parts.shift();
  const [first, ...rest] = parts;
  const kind = kindOf(first, check);
  if (['light', 'warp', 'off default'].includes(first) && rest.length > 0) return makePlace(kind, rest[0], rest.slice(1), control);
  const variant = first.match(/^([a-z]+_\S+|BSDF samples beside lights|paths) (.*)$/);  // "furnace_sphere depth 1"
  return variant ? makePlace(kind, variant[1], [variant[2], ...rest], control) : makePlace(kind, first, rest, control);
}

function makePlace(kind, thing, rest, control) {
  const row = rest.map(rowPart).filter(Boolean).join(' · ');
  return {kind: control ? kControls : kind, thing: nameOf(thing), row: row || nameOf(thing)};
}
