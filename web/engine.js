'use strict';
// One page over the library: no physics and no verdict is made here. Questions and answers are those of web/src/question.rs.

const $ = (id) => document.getElementById(id);
const MM = 1e3;

// ---- The library, opened in this page and once more in a worker ----

async function opened(module) {
  // Crates for drawing name functions of a browser that no question reaches.
  const unused = new Proxy(
    {},
    {
      get: () => () => {
        throw new Error('not in a browser');
      },
    },
  );
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = unused.any;
  const { exports } = await WebAssembly.instantiate(module, imports);
  const bytes = new TextEncoder(),
    words = new TextDecoder();
  return (question) => {
    const asked = bytes.encode(JSON.stringify(question));
    // The memory may grow in a call, and is another buffer then.
    const room = exports.room(asked.length);
    new Uint8Array(exports.memory.buffer, room, asked.length).set(asked);
    const length = exports.ask();
    return JSON.parse(words.decode(new Uint8Array(exports.memory.buffer, exports.answer(), length)));
  };
}

async function unpacked() {
  const packed = Uint8Array.from(atob($('engine').textContent.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

function worked(module) {
  const main = `${opened}; let ask; onmessage = async ({ data: { module, id, question } }) => {
    try { if (module) return void (ask = opened(module)); postMessage({ id, told: (await ask)(question) }); }
    catch (error) { postMessage({ id, told: { error: { message: 'the library stopped: ' + error.message, help: 'please report it' } } }); } };`;
  const worker = new Worker(URL.createObjectURL(new Blob([main], { type: 'text/javascript' })));
  const waiting = new Map();
  let count = 0;
  worker.onmessage = ({ data: { id, told } }) => {
    waiting.get(id)(told);
    waiting.delete(id);
  };
  worker.postMessage({ module });
  return (question) =>
    new Promise((done) => {
      waiting.set(++count, done);
      worker.postMessage({ id: count, question });
    });
}

function ok(told) {
  if (told.error) throw Object.assign(new Error(told.error.message), { help: told.error.help });
  return told.ok;
}
