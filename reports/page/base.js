'use strict';

// What every section uses: the data, elements, numbers, tables.

let data = null;  // what the page shows; main.js unpacks it

/** An element with properties and children; text is always text, never markup. */
function element(tag, properties = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name === 'className' ? 'class' : name, value === true ? '' : value);
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return node;
}

/** Numbers arrive as JSON numbers, null (NaN: not applicable), "inf" or "-inf". */
function toNumber(value) {
  if (value === 'inf') return Infinity;
  if (value === '-inf') return -Infinity;
  return value === null || value === undefined ? NaN : value;
}

function formatNumber(value, digits = 5) {
  const x = toNumber(value);
  if (Number.isNaN(x)) return '–';
  if (!Number.isFinite(x)) return x > 0 ? '∞' : '−∞';
  if (x === 0) return '0';
  const size = Math.abs(x);
  if (size >= 1e6 || size < 1e-3) {
    const [mantissa, exponent] = x.toExponential(Math.max(0, Math.min(digits, 3) - 1)).split('e');
    return minus(`${mantissa}e${exponent.replace('+', '')}`);
  }
  const text = plainPrecision(x, digits);
  return minus(text.includes('.') ? text.replace(/\.?0+$/, '') : text);
}

/** toPrecision() without the exponent that it gives numbers with more digits before the point. */
function plainPrecision(x, digits) {
  const text = x.toPrecision(digits);
  return text.includes('e') ? String(Number(text)) : text;
}

function minus(text) {
  return text.replaceAll('-', '−');
}

/** All significant digits, so that the numbers of a column line up. */
function formatAligned(value, digits = 5) {
  const x = toNumber(value);
  const size = Math.abs(x);
  return size >= 1e-3 && size < 1e5 ? minus(plainPrecision(x, digits)) : formatNumber(x, digits);
}

/** A relative size in per cent with two significant digits. */
function formatPercent(value) {
  const x = toNumber(value);
  if (Number.isNaN(x)) return '–';
  if (!Number.isFinite(x)) return '∞';
  if (x === 0) return '0 %';
  const percent = Math.abs(x) * 100;
  if (percent >= 1000 || percent < 1e-3) return `${formatNumber(percent, 2)} %`;
  return `${percent >= 10 ? percent.toFixed(0) : percent.toPrecision(2)} %`;
}

/** 1,310,720 as "1.31 M". */
function formatCount(value) {
  for (const [unit, suffix] of [[1e12, ' T'], [1e9, ' G'], [1e6, ' M'], [1e4, ' k']]) {
    if (value >= unit) return (value / (suffix === ' k' ? 1e3 : unit)).toPrecision(3) + suffix;
  }
  return String(value);
}

function formatSeconds(value) {
  const x = toNumber(value);
  if (Number.isNaN(x)) return '–';
  if (x === 0) return '0';
  if (x >= 100) return x.toFixed(0);
  if (x >= 10) return x.toFixed(1);
  return x >= 1e-3 ? x.toFixed(3) : '< 0.001';
}

function formatInterval(low, high, digits = 3) {
  if (Number.isNaN(toNumber(low)) && Number.isNaN(toNumber(high))) return '–';
  return `${formatNumber(low, digits)} … ${formatNumber(high, digits)}`;
}

const naturalOrder = new Intl.Collator('en', {numeric: true}).compare;

/** NaN sorts last, in either direction. */
function compareValues(a, b, sign) {
  if (typeof a === 'string') return sign * naturalOrder(a, b);
  if (Number.isNaN(a) || Number.isNaN(b)) return Number.isNaN(a) - Number.isNaN(b);
  return sign * (a < b ? -1 : a > b ? 1 : 0);
}

/**
 * A column: {name, title?, number?, sort(row) → text or number, cell(row) → text or nodes, className?}.
 */
function headerCell(column, state, changed) {
  const sorted = state.column === column;
  const direction = state.sign > 0 ? 'ascending' : 'descending';
  return element(
    'th',
    {
      className: [column.number && 'number', column.className].filter(Boolean).join(' ') || null,
      'aria-sort': sorted ? direction : null,
      title: column.title,
      scope: 'col',
    },
    column.sort
      ? element('button', {
          type: 'button',
          onclick: () => {
            state.sign = sorted ? -state.sign : 1;
            state.column = column;
            changed();
          },
        }, column.name)
      : column.name,
    column.axis ? column.axis() : null,
  );
}

function bodyCell(column, row) {
  const content = column.cell(row);
  const empty = content === '–' || content === '';
  const names = [column.number && 'number', empty && 'none', column.className];
  return element('td', {className: names.filter(Boolean).join(' ') || null}, content);
}

/** A table without anything to focus, in a box that keys can scroll. */
const scrollBox = (name, table) => element('div', {className: 'scroll', role: 'group', tabindex: 0, 'aria-label': name}, table);

/** A sortable table of rows that all have the same columns. */
function sortableTable(columns, rows) {
  const state = {column: null, sign: 1};
  const head = element('thead');
  const body = element('tbody');
  const draw = () => {
    const sorted = state.column
      ? [...rows].sort((a, b) => compareValues(state.column.sort(a), state.column.sort(b), state.sign))
      : rows;
    head.replaceChildren(element('tr', {}, columns.map((c) => headerCell(c, state, draw))));
    body.replaceChildren(...sorted.map((row) => element('tr', {}, columns.map((c) => bodyCell(c, row)))));
  };
  draw();
  return element('div', {className: 'scroll'}, element('table', {}, head, body));
}

/** Lets a row with a button show another below it; returns what does that without a click. */
function openOnClick(row, makeDetails) {
  let details = null;
  const toggle = () => {
    if (details) details.remove();
    details = details ? null : makeDetails();
    if (details) row.after(details);
    row.querySelector('button').setAttribute('aria-expanded', String(details !== null));
  };
  row.addEventListener('click', () => {
    if (String(getSelection()) === '') toggle();
  });
  return toggle;
}

const textColumn = (name, get, more = {}) => ({name, sort: get, cell: get, ...more});
const numberColumn = (name, get, format = formatNumber, more = {}) => ({
  name,
  number: true,
  sort: (row) => toNumber(get(row)),
  cell: (row) => format(get(row)),
  ...more,
});

function verdictBadge(check) {
  const wrong = check.as_expected ? '' : ' wrong';
  const waived = check.waived ? ', waived' : '';
  return element('span', {className: `badge ${check.waived ? 'inconclusive' : check.verdict}${wrong}`}, check.verdict + waived);
}

function groupBy(list, key) {
  const groups = new Map();
  for (const item of list) {
    const name = key(item);
    if (!groups.has(name)) groups.set(name, []);
    groups.get(name).push(item);
  }
  return groups;
}

// Intervals drawn in a table cell, all cells of a column on one axis.

function makeScale(values, log) {
  const finite = values.map(toNumber).filter((x) => Number.isFinite(x) && (!log || x > 0));
  const f = log ? Math.log10 : (x) => x;
  let low = Math.min(...finite.map(f), f(1));
  let high = Math.max(...finite.map(f), f(1));
  const margin = 0.06 * (high - low || 1);
  low = log ? low - margin : Math.min(0, low);
  high += margin;
  const position = (x) => Math.min(100, Math.max(0, (100 * (f(x) - low)) / (high - low)));
  return {position, ticks: log ? decades(low, high) : [0, 0.5, 1, 1.5, 2].filter((t) => t <= high)};
}

function decades(low, high) {
  const ticks = [];
  const step = Math.ceil((high - low) / 5) || 1;
  for (let e = Math.ceil(low); e <= high; ++e) {
    if (e % step === 0) ticks.push(10 ** e);
  }
  return ticks.includes(1) ? ticks : [1, ...ticks];
}

function intervalColumn(name, scale, get) {
  return {
    name,
    className: 'axis-cell',
    axis: () =>
      element('div', {className: 'ticks'}, scale.ticks.map((t) =>
        element('span', {style: `left:${scale.position(t)}%`}, formatNumber(t, 3)))),
    cell: (row) => {
      const {low, value, high} = get(row);
      const left = scale.position(toNumber(low));
      const width = scale.position(toNumber(high)) - left;
      return element(
        'div',
        {className: 'interval'},
        scale.ticks.map((t) =>
          element('i', {className: t === 1 ? 'one' : null, style: `left:${scale.position(t)}%`})),
        Number.isFinite(width) ? element('b', {style: `left:${left}%;width:${width}%`}) : null,
        element('u', {style: `left:${scale.position(toNumber(value))}%`}),
      );
    },
  };
}
