
// The views of the page: one is shown at a time, made when it is first opened, and linked to as #name or
// #name/more.

const views = [];
let shownView = null;

/**
 * Adds a view and its entry in the side bar.
 * @param group  heading in the side bar; null: no entry, the view is reached from others
 * @param count  shown in the side bar, null for none
 * @param make   called when the view is first shown → nodes
 * @param open   called each time it is shown, with the section and what follows the view's name in the address
 */
function addView({id, group = null, title, count = null, about = '', make = () => [], open = null}) {
  views.push({id, group, title, count, about, make, open, section: null, link: null, scroll: 0});
}

const listedViews = () => views.filter((view) => view.group !== null);

/** Parts of an address are text of any kind, so that a subject with a slash is one part. */
const addressOf = (...parts) => `#${parts.map(encodeURIComponent).join('/')}`;

function partsOf(address) {
  try {
    return address.replace(/^#/, '').split('/').map(decodeURIComponent);
  } catch {
    return [''];  // a stray % that somebody typed
  }
}

const waiting = new Set();  // where something is made as it comes near the window

/** Makes a node as its place comes near the window: decoding all pictures, or drawing all plots, takes time. */
function whenNear(make, className = null) {
  const node = element('div', {className});
  const fill = () => {
    observer.disconnect();
    waiting.delete(place);
    node.replaceWith(make());
  };
  const observer = new IntersectionObserver((entries) => {
    if (entries.some((entry) => entry.isIntersecting)) fill();
  }, {rootMargin: '600px'});
  const place = {node, fill};
  observer.observe(node);
  waiting.add(place);
  return node;
}

function makeView(view) {
  const head = element('div', {className: 'section-head'}, element('h2', {}, view.title),
    view.about ? element('p', {}, view.about) : null);
  view.section = element('section', {id: `view-${view.id}`, className: 'view'}, head, view.make());
  const next = views.slice(views.indexOf(view) + 1).find((v) => v.section);  // on paper they stand in this order
  document.querySelector('main').insertBefore(view.section, next?.section ?? null);
}

function showOnly(isShown) {
  for (const view of views) if (view.section) view.section.hidden = !isShown(view);
}

function showAddress() {
  const [id, ...rest] = partsOf(location.hash);
  const view = views.find((v) => v.id === id) ?? views[0];
  if (shownView) shownView.scroll = scrollY;
  if (!view.section) makeView(view);
  showOnly((other) => other === view);
  for (const other of listedViews()) other.link.toggleAttribute('aria-current', other === view);
  if (view !== shownView) scrollTo(0, view.open ? 0 : view.scroll);
  view.open?.(view.section, rest);
  document.title = `${view.title} · Plumbline`;
  drawCharts();
  shownView = view;
  view.link?.scrollIntoView({block: 'nearest', inline: 'nearest'});
}

function addSideBar() {
  const links = document.getElementById('contents');
  let number = 0;
  for (const [group, members] of groupBy(listedViews(), (view) => view.group)) {
    links.append(element('h2', {}, group));
    for (const view of members) {
      const key = ++number <= 9 ? String(number) : null;
      view.link = element('a', {href: `#${view.id}`, title: key ? `Key ${key}` : null}, view.title,
        view.count === null ? null : element('span', {}, formatCount(view.count)));
      links.append(view.link);
    }
  }
}

const isTyped = (target) => target.matches('input, select, textarea');

function stepView(step) {
  const list = listedViews();
  const at = list.indexOf(shownView);
  const next = list[at < 0 ? 0 : Math.max(0, Math.min(list.length - 1, at + step))];
  location.hash = next.id;
}

/** Keys: / searches, 1 to 9 and the arrows left and right go from view to view. */
function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || isTyped(event.target)) return;
  const step = event.target.matches('[tabindex]') ? 0 : {ArrowLeft: -1, ArrowRight: 1}[event.key];  // what scrolls takes them
  const view = /^[1-9]$/.test(event.key) ? listedViews()[Number(event.key) - 1] : null;
  if (event.key === '/') {
    event.preventDefault();
    document.getElementById('find').focus();
  } else if (step) {
    stepView(step);
  } else if (view) {
    location.hash = view.id;
  }
}

function startViews() {
  addSideBar();
  history.scrollRestoration = 'manual';
  addEventListener('hashchange', showAddress);
  addEventListener('keydown', onKey);
  showAddress();
}
