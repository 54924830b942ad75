
// Rendered images: linear floats drawn on a canvas; any two of a scene on either side of a slider.

/** The sRGB transfer function (IEC 61966-2-1), to 8 bits. */
function encodeSrgb(linear) {
  if (!(linear > 0)) return 0;
  const x = Math.min(linear, 1);
  return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
}

/** Pixels that are not finite are shown in magenta, so that they are seen. */
function paint(canvas, image, stops) {
  canvas.width = image.width;
  canvas.height = image.height;
  const context = canvas.getContext('2d');
  const gain = 2 ** stops;
  const target = context.createImageData(image.width, image.height);
  for (let i = 0; i < image.width * image.height; ++i) {
    const rgb = image.floats.subarray(3 * i, 3 * i + 3);
    const finite = rgb.every(Number.isFinite);
    for (let c = 0; c < 3; ++c) target.data[4 * i + c] = finite ? encodeSrgb(rgb[c] * gain) : [255, 0, 255][c];
    target.data[4 * i + 3] = 255;
  }
  context.putImageData(target, 0, 0);
}

/** Stops that bring the bright part of the images (their 98th percentile) to just below white. */
function startingExposure(images) {
  const bright = images.map(({floats}) => {
    const finite = floats.filter(Number.isFinite).sort();
    return finite[Math.floor(0.98 * (finite.length - 1))] ?? 0;
  });
  const brightest = Math.max(...bright);
  if (!(brightest > 0)) return 0;
  return Math.max(-10, Math.min(10, Math.floor(2 * Math.log2(0.9 / brightest)) / 2));
}

const kZooms = [1, 2, 4, 8, 16];
const kWidest = 8192;  // of a canvas on the page [CSS pixels]

/** Pictures of one scene: two at a time, with a slider between them, an exposure, and a zoom to single pixels. */
class Comparison {
  constructor(name, images) {
    this.name = name;
    this.images = images;
    const named = (part) => images.findIndex((image) => image.name.startsWith(part));
    const right = Math.max(0, named('mis'));
    const left = Math.max(named('bsdf'), images.length > 1 && right === 0 ? 1 : 0);
    this.chosen = [images[left], images[right]];
    this.split = 50;
    this.canvases = [0, 1].map(() => element('canvas', {role: 'img', 'aria-label': `${nameOf(name)}, rendered`}));
    this.canvases[1].classList.add('over');
    this.line = element('div', {className: 'split-line'});
    this.stack = element('div', {
      className: 'stack',
      onpointermove: (event) => this.read(event),
      onpointerleave: () => this.describe(),
    }, this.canvases, this.comparable() ? this.line : null);
    this.reading = element('p', {className: 'value', role: 'status'});
  }

  comparable() {
    return this.images.length > 1;
  }

  node() {
    const caption = this.comparable()
      ? element('div', {className: 'sides'}, this.chooser(0), this.chooser(1))
      : element('p', {className: 'muted'}, this.images[0].name);
    const controls = element('div', {className: 'controls'}, this.exposureSlider(), this.zoomButtons());
    const result = element('div', {className: 'comparison'}, caption,
      element('div', {className: 'window', role: 'group', tabindex: 0, 'aria-label': `Picture of ${nameOf(this.name)}`}, this.stack), this.comparable() ? this.splitSlider() : null, this.reading, controls);
    this.start();
    return result;
  }

  async start() {
    await Promise.all(this.images.map(floatsOf));
    this.stops = startingExposure(this.images);
    this.exposure.value = this.stops;
    this.draw();
  }

  draw() {
    this.canvases.forEach((canvas, side) => paint(canvas, this.chosen[side], this.stops));
    this.exposureLabel.textContent = `${this.stops > 0 ? '+' : ''}${minus(this.stops.toFixed(1))} EV`;
    this.drawSplit();
    this.describe();
  }

  drawSplit() {
    const split = this.comparable() ? this.split : 0;
    this.canvases[1].style.clipPath = `inset(0 0 0 ${split}%)`;
    this.line.style.left = `${split}%`;
  }

  chooser(side) {
    return element('select', {
      'aria-label': side === 0 ? 'Picture on the left' : 'Picture on the right',
      onchange: (event) => {
        this.chosen[side] = this.images[event.target.selectedIndex];
        this.draw();
      },
    }, this.images.map((image) => element('option', {selected: image === this.chosen[side]}, image.name)));
  }

  splitSlider() {
    return element('input', {
      type: 'range', className: 'split', min: 0, max: 100, step: 0.5, value: this.split, 'aria-label': 'Between the two pictures',
      oninput: (event) => {
        this.split = event.target.valueAsNumber;
        this.drawSplit();
      },
    });
  }

  exposureSlider() {
    this.exposureLabel = element('output', {});
    this.exposure = element('input', {
      type: 'range', min: -10, max: 10, step: 0.5, 'aria-label': 'Exposure',
      oninput: (event) => {
        this.stops = event.target.valueAsNumber;
        this.draw();
      },
    });
    return element('label', {className: 'exposure'}, 'Exposure', this.exposure, this.exposureLabel);
  }

  zoomButtons() {
    const buttons = kZooms.map((zoom) => element('button', {
      type: 'button', 'aria-pressed': String(zoom === 1),
      onclick: (event) => {
        this.stack.style.width = `min(${100 * zoom}%, ${kWidest}px)`;
        for (const button of buttons) button.setAttribute('aria-pressed', String(button === event.target));
      },
    }, `${zoom}×`));
    return element('div', {className: 'chips', role: 'group', 'aria-label': 'Zoom'}, buttons);
  }

  describe() {
    const {width, height} = this.chosen[1];
    this.reading.textContent = `${width} × ${height}; point at a pixel to read it`;
  }

  read(event) {
    const box = this.stack.getBoundingClientRect();
    const across = (event.clientX - box.left) / box.width;
    const down = (event.clientY - box.top) / box.height;
    const values = (this.comparable() ? this.chosen : [this.chosen[1]]).map((image) => pixelText(image, across, down));
    this.reading.textContent = values.join('   |   ');
  }
}

function pixelText({width, height, floats}, across, down) {
  if (!floats) return '';
  const clamp = (x, size) => Math.max(0, Math.min(size - 1, Math.floor(x * size)));
  const [x, y] = [clamp(across, width), clamp(down, height)];
  const first = 3 * (y * width + x);
  const rgb = [...floats.subarray(first, first + 3)].map((v) => formatNumber(v, 3));
  return `(${x}, ${y}) ${rgb.join(' ')}`;
}

const badCount = (count) =>
  count > 0 ? element('span', {className: 'bad-number'}, count.toLocaleString('en')) : '0';

function renderTable() {
  const perPath = (r) => (r.camera_rays + r.bounce_rays + r.shadow_rays) / r.camera_rays;
  const parameters = (r) => Object.entries(r.parameters).map(([k, v]) => `${k}=${v}`).join(' ');
  const columns = [
    textColumn('Scene', (r) => nameOf(r.scene)),
    textColumn('Strategy', (r) => r.strategy),
    textColumn('Heuristic', (r) => r.heuristic || '–'),
    textColumn('Parameters', (r) => parameters(r) || '–'),
    numberColumn('Samples/pixel', (r) => r.spp, String),
    numberColumn('Depth', (r) => r.max_depth, (depth) => (depth < 0 ? '∞' : String(depth))),
    numberColumn('Seconds', (r) => r.seconds, formatSeconds),
    numberColumn('Rays/path', perPath, (x) => formatNumber(x, 3)),
    numberColumn('Shadow rays', (r) => r.shadow_rays, formatCount),
    numberColumn('Rejected', (r) => r.rejected, formatCount),
    {name: 'Non-finite', number: true, sort: (r) => r.non_finite, cell: (r) => badCount(r.non_finite)},
    {name: 'Mean RGB', number: true, cell: (r) => r.mean.map((v) => formatNumber(v, 5)).join('  ')},
    textColumn('Seed', (r) => r.seed, {number: true}),
  ];
  return sortableTable(columns, data.renders.filter((r) => r.camera_rays > 0));  // the others are maps
}
