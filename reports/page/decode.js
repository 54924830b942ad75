
// What the page carries is deflated and in base64.

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflate(base64) {
  const stream = new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

async function readData() {
  const text = document.getElementById('data').textContent;
  const read = JSON.parse(new TextDecoder().decode(await inflate(text)));
  const lines = document.getElementById('images').textContent.trim().split('\n');
  read.images.forEach((image, index) => { image.packed = lines[index]; });
  return read;
}

/** The values of an image, unpacked when they are first asked for: upper halves of floats. */
async function floatsOf(image) {
  if (image.floats) return image.floats;
  const halves = new DataView(await inflate(image.packed));
  const bits = new Uint32Array(halves.byteLength / 2);
  for (let i = 0; i < bits.length; ++i) bits[i] = halves.getUint16(2 * i, true) << 16;
  image.floats = new Float32Array(bits.buffer);
  return image.floats;
}
