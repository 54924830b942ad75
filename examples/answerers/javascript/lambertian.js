// A Lambertian BSDF that answers plumbline (docs/protocol.md): plumbline verify --exec 'node lambertian.js'
// With --faulty it states the pdf of uniform directions, not of those that it samples.
const fs = require('fs');

const faulty = process.argv.includes('--faulty'), albedo = 0.8;
const above = (wo, wi) => wo[2] > 0 && wi[2] > 0;
const pdf = (wo, wi) => above(wo, wi) ? (faulty ? 0.5 : wi[2]) / Math.PI : 0; // [1/sr]
const evaluate = (wo, wi) => above(wo, wi) ? albedo / Math.PI : 0; // f [1/sr], without the cosine
const sample = (u) => {
  const r = Math.sqrt(u[0]), phi = 2 * Math.PI * u[1];
  return [r * Math.cos(phi), r * Math.sin(phi), Math.sqrt(1 - u[0])];
};

function readBytes(count) {
  const bytes = Buffer.alloc(count);
  for (let n = 0; n < count;) {
    const got = fs.readSync(0, bytes, n, count - n);
    if (got === 0) process.exit(n === 0 ? 0 : 1);
    n += got;
  }
  return bytes;
}
function readLine() {
  let line = '';
  while (!line.endsWith('\n')) line += readBytes(1).toString();
  return line;
}
function readArray(count) { // after a header, which is 128 bytes long
  const bytes = readBytes(128 + 8 * count);
  return new Float64Array(bytes.buffer, bytes.byteOffset + 128, count);
}
function write(bytes) {
  for (let n = 0; n < bytes.length;) n += fs.writeSync(1, bytes, n);
}
function writeArray(array, type, count, columns = '') {
  const words = `{'descr': '${type}', 'fortran_order': False, 'shape': (${count},${columns}), }`;
  write(Buffer.concat([Buffer.from('\x93NUMPY\x01\x00\x76\x00' + words.padEnd(117) + '\n', 'latin1'),
                       Buffer.from(array.buffer)]));
}

write(Buffer.from(JSON.stringify({protocol: 'plumbline/1', name: 'lambertian', precision: 'float64',
                                  numbers: 2, functions: ['sample', 'pdf', 'eval']}) + '\n'));
for (;;) {
  const line = readLine(), {kind, count} = JSON.parse(line), sampling = kind === 'sample';
  const wo = readArray(3 * count), given = readArray((sampling ? 2 : 3) * count);
  const wi = sampling ? new Float64Array(3 * count) : given, accepted = new Uint8Array(count);
  const density = new Float64Array(count), value = new Float64Array(count);
  for (let i = 0; i < count; ++i) {
    const o = wo.subarray(3 * i, 3 * i + 3), w = wi.subarray(3 * i, 3 * i + 3);
    if (sampling) w.set(sample(given.subarray(2 * i, 2 * i + 2)));
    accepted[i] = above(o, w), density[i] = pdf(o, w), value[i] = evaluate(o, w);
    if (sampling && accepted[i]) value[i] *= w[2] / density[i];
  }
  write(Buffer.from(line)); // an answer begins with the line of its query
  if (sampling) writeArray(wi, '<f8', count, ' 3');
  if (kind !== 'eval') writeArray(density, '<f8', count);
  if (kind !== 'pdf') writeArray(value, '<f8', count);
  if (sampling) writeArray(accepted, '|b1', count);
}
