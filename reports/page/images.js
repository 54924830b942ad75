
// Rendered images: linear floats drawn on a canvas under an exposure that a group shares.

function decodeFloats(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const view = new DataView(bytes.buffer);
  const floats = new Float32Array(bytes.length / 4);
  for (let i = 0; i < floats.length; ++i) floats[i] = view.getFloat32(4 * i, true);
  return floats;
}

/** The sRGB transfer function (IEC 61966-2-1), to 8 bits. */
function encodeSrgb(linear) {
  if (!(linear > 0)) return 0;
  const x = Math.min(linear, 1);
  return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
}

/** Pixels that are not finite are shown in magenta, so that they are seen. */
function paint(context, image, stops) {
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

/** Stops that bring the bright part of the group (its 98th percentile) to just below white. */
function startingExposure(images) {
  const bright = images.map(({floats}) => {
    const finite = [...floats].filter(Number.isFinite).sort((a, b) => a - b);
    return finite[Math.floor(0.98 * (finite.length - 1))] ?? 0;
  });
  const brightest = Math.max(...bright);
  if (!(brightest > 0)) return 0;
  return Math.max(-10, Math.min(10, Math.floor(2 * Math.log2(0.9 / brightest)) / 2));
}

class Picture {
  constructor(image, aimed) {
    this.image = {...image, floats: decodeFloats(image.data)};
    this.canvas = element('canvas', {
      width: image.width,
      height: image.height,
      role: 'img',
      'aria-label': `${image.group}, ${image.name}`,
      onmousemove: (event) => aimed(this.pixelUnder(event)),
      onmouseleave: () => aimed(null),
    });
    this.aim = element('div', {className: 'aim'});
    this.value = element('span', {className: 'value'}, `${image.width} × ${image.height}`);
  }

  node() {
    return element('figure', {className: 'picture'},
      element('div', {className: 'canvas'}, this.canvas, this.aim),
      element('figcaption', {}, element('span', {}, this.image.name), this.value));
  }

  draw(stops) {
    paint(this.canvas.getContext('2d'), this.image, stops);
  }

  pixelUnder(event) {
    const box = this.canvas.getBoundingClientRect();
    const clamp = (x, size) => Math.max(0, Math.min(size - 1, Math.floor(x)));
    return {
      x: clamp(((event.clientX - box.left) / box.width) * this.image.width, this.image.width),
      y: clamp(((event.clientY - box.top) / box.height) * this.image.height, this.image.height),
    };
  }

  show(pixel) {
    const {width, height, floats} = this.image;
    const inside = pixel && pixel.x < width && pixel.y < height;
    this.aim.style.display = inside ? 'block' : 'none';
    if (!inside) {
      this.value.textContent = `${width} × ${height}`;
      return;
    }
    const side = this.canvas.clientWidth / width;
    const box = Math.max(side, 6);
    this.aim.style.width = this.aim.style.height = `${box}px`;
    this.aim.style.left = `${(pixel.x + 0.5) * side - box / 2}px`;
    this.aim.style.top = `${(pixel.y + 0.5) * side - box / 2}px`;
    const first = 3 * (pixel.y * width + pixel.x);
    const rgb = [...floats.subarray(first, first + 3)].map((v) => formatNumber(v, 4));
    this.value.textContent = `(${pixel.x}, ${pixel.y})  ${rgb.join(' ')}`;
  }
}

function pictureGroup(name, images) {
  const pictures = [];
  const aimed = (pixel) => pictures.forEach((picture) => picture.show(pixel));
  for (const image of images) pictures.push(new Picture(image, aimed));
  const start = startingExposure(pictures.map((p) => p.image));
  const label = element('output', {});
  const draw = (stops) => {
    label.textContent = `${stops > 0 ? '+' : ''}${minus(stops.toFixed(1))} EV`;
    pictures.forEach((picture) => picture.draw(stops));
  };
  const slider = element('input', {
    type: 'range', min: -10, max: 10, step: 0.5, value: start, title: 'Double-click: back to the start',
    oninput: () => draw(slider.valueAsNumber),
    ondblclick: () => {
      slider.value = start;
      draw(start);
    },
  });
  draw(start);
  return element('div', {className: 'card'}, element('h3', {}, name),
    element('div', {className: 'pictures'}, pictures.map((picture) => picture.node())),
    element('label', {className: 'exposure'}, 'Exposure', slider, label));
}

const badCount = (count) =>
  count > 0 ? element('span', {className: 'bad-number'}, count.toLocaleString('en')) : '0';

function renderTable() {
  const perPath = (r) => (r.camera_rays + r.bounce_rays + r.shadow_rays) / r.camera_rays;
  const parameters = (r) => Object.entries(r.parameters).map(([k, v]) => `${k}=${v}`).join(' ');
  const columns = [
    textColumn('Scene', (r) => r.scene),
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

function addImages() {
  if (data.images.length === 0 && data.renders.length === 0) return;
  const groups = [...groupBy(data.images, (image) => image.group)];
  addSection('images', 'Rendered images', data.images.length,
    'Linear values; point at a pixel to read it, in all images of the scene at once.',
    element('div', {className: 'groups'}, groups.map(([name, images]) => pictureGroup(name, images))),
    data.renders.some((r) => r.camera_rays > 0) ? renderTable() : null);
}
