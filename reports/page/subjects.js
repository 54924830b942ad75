
// What the subjects of checks are: the one place that reads their names.

/** What a scene of the literature is called. */
const kSceneNames = {veach: 'Veach’s plates', veach_phong: 'Veach’s plates, Phong lobes', cornell: 'Cornell box'};

/** A scene by its name alone, whether it was one that the command knows or a file. */
const sceneOf = (group) => group.replace(/^.*\//, '').replace(/\.xml$/, '');

/** Names in one style: "GgxConductor" → "GGX conductor", "furnace_sphere" → "Furnace sphere". */
function nameOf(name) {
  const scene = sceneOf(name);
  if (kSceneNames[scene]) return kSceneNames[scene];
  const words = scene.replaceAll('_', ' ').replace(/([a-z])([A-Z])/g, (_, a, b) => `${a} ${b.toLowerCase()}`);
  const sentence = words.replace(/^ggx\b/i, 'GGX').replace(/^mis\b/, 'MIS');
  return sentence.charAt(0).toUpperCase() + sentence.slice(1);
}
