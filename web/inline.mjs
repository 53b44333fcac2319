// Puts style, program and library into web/dist/ibr.html, and says how large it is.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';

/** A module without its custom sections, which are for tools: each section is a number, its length and its bytes. */
function bare(wasm) {
  const kept = [wasm.subarray(0, 8)];
  for (let at = 8; at < wasm.length;) {
    const from = at++;
    let length = 0;
    for (let shift = 0, more = true; more; shift += 7) {
      length += (wasm[at] & 127) * 2 ** shift;
      more = wasm[at++] > 127;
    }
    at += length;
    if (wasm[from] !== 0) kept.push(wasm.subarray(from, at));
  }
  return Buffer.concat(kept);
}

const here = (name) => new URL(name, import.meta.url);
const text = (name) => readFileSync(here(name), 'utf8').trim();
const engine = gzipSync(bare(readFileSync(process.argv[2])), { level: 9 }).toString('base64');
const parts = {
  '/*page.css*/': text('page.css'),
  '/*page.js*/': ['engine.js', 'draw.js', 'measured.js', 'page.js'].map(text).join('\n'),
  '<!--engine-->': engine,
};
const page = Object.entries(parts).reduce((page, [place, part]) => page.replace(place, () => part), text('index.html'));
mkdirSync(here('dist/'), { recursive: true });
writeFileSync(here('dist/ibr.html'), `${page}\n`);
const kb = (bytes) => `${Math.ceil(bytes.length / 1000)} kB`;
console.log(`web/dist/ibr.html: ${kb(Buffer.from(page))}, ${kb(gzipSync(page, { level: 9 }))} gzipped`);
