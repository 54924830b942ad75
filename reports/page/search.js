
// Find as you type, over everything that has a name on the page. Its address is #find/words.

const kFoundAtMost = 60;

const searchItem = (kind, title, about, href, more = '') =>
  ({kind, title, about, href, text: `${title} ${about} ${more}`.toLowerCase()});

function searchItems() {
  const checkItem = (c) => searchItem('Checks', c.subject, `${c.check} · ${c.verdict}`, checkAddress(c),
    `${c.leaned_on} ${c.diagnosis} ${c.as_expected ? '' : 'unexpected'} ${c.waived ? 'waived' : ''}`);
  const scenes = [...groupBy(data.images, (image) => image.group)].map(([name, images]) =>
    searchItem('Pictures', nameOf(name), images.map((i) => i.name).join(' · '), addressOf('images', name), name));
  const figures = [...data.figures, ...data.tables].map((f) =>
    searchItem('Figures and tables', f.title, f.group, `#${figureViewOf(f.group)}`, f.caption));
  const bars = data.bars.map((b) => searchItem('Bars', b.name, b.verdict, '#bars', b.note));
  const twins = data.causes.flatMap((record) => record.twins.map((t) =>
    searchItem('Faults put in', t.name, t.fault, '#causes', `${t.expected} ${t.named}`)));
  const numbers = data.history.flatMap((record) => record.numbers.map((n) =>
    searchItem('Numbers over nights', n.name, n.unit, numberAddress(n), n.changes.map(changeKind).join(' '))));
  const sequences = data.history.flatMap((record) => record.sequences.map((s) =>
    searchItem('Checks over nights', s.subject, `${s.check} · ${s.verdict}`, addressOf('history', 'part', 'sequences'))));
  return [
    ...listedViews().map((v) => searchItem('Views', v.title, v.about, `#${v.id}`)),
    ...scenes, ...bars, ...figures, ...numbers, ...data.checks.map(checkItem), ...sequences, ...twins,
  ];
}

let everything = null;

function find(text) {
  everything ??= searchItems();
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  return words.length === 0 ? [] : everything.filter((item) => words.every((word) => item.text.includes(word)));
}

function foundGroup(kind, items) {
  const left = items.length - kFoundAtMost;
  return element('div', {className: 'card found'}, element('h3', {}, kind, element('span', {className: 'aside'}, String(items.length))),
    element('ul', {}, items.slice(0, kFoundAtMost).map((item) =>
      element('li', {}, element('a', {href: item.href}, item.title), element('span', {className: 'muted'}, item.about)))),
    left > 0 ? element('p', {className: 'muted'}, `and ${left} more: another word narrows them down`) : null);
}

function showFound(section, [text = '']) {
  const field = document.getElementById('find');
  if (field.value.trim() !== text) field.value = text;
  const found = find(text);
  section.querySelector('.results').replaceChildren(
    element('p', {className: 'muted', role: 'status'}, `${found.length} found`),
    ...[...groupBy(found, (item) => item.kind)].map(([kind, items]) => foundGroup(kind, items)));
}

function addSearch() {
  addView({id: 'find', title: 'Found', make: () => [element('div', {className: 'results'})], open: showFound});
  const field = document.getElementById('find');
  let before = '#overview';
  field.addEventListener('input', () => {
    const text = field.value.trim();
    const searching = location.hash.startsWith('#find/');  // the view follows only after the next letter
    if (!searching) before = location.hash || '#overview';
    if (text === '') {
      location.hash = before;
    } else if (searching) {
      history.replaceState(null, '', addressOf('find', text));
      showAddress();
    } else {
      location.hash = addressOf('find', text);
    }
  });
  field.addEventListener('keydown', (event) => {
    if (event.key === 'Enter') document.querySelector('#view-find .results a')?.focus();
    if (event.key !== 'Escape') return;
    field.value = '';
    field.dispatchEvent(new Event('input'));
    field.blur();
  });
}
