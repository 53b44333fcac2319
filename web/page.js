'use strict';
// One page over the library: no physics and no verdict is made here. Questions and answers are those of web/src/question.rs.

const $ = id => document.getElementById(id);
const MM = 1e3;

// ---- The library, opened in this page and once more in a worker ----

async function opened(module) {
  // Crates for drawing name functions of a browser that no question reaches.
  const unused = new Proxy({}, { get: () => () => { throw new Error('not in a browser'); } });
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = unused.any;
  const { exports } = await WebAssembly.instantiate(module, imports);
  const bytes = new TextEncoder(), words = new TextDecoder();
  return question => {
    const asked = bytes.encode(JSON.stringify(question));
    new Uint8Array(exports.memory.buffer, exports.room(asked.length), asked.length).set(asked);
    const length = exports.ask();
    return JSON.parse(words.decode(new Uint8Array(exports.memory.buffer, exports.answer(), length)));
  };
}

async function unpacked() {
  const packed = Uint8Array.from(atob($('engine').textContent.trim()), c => c.charCodeAt(0));
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
  worker.onmessage = ({ data: { id, told } }) => { waiting.get(id)(told); waiting.delete(id); };
  worker.postMessage({ module });
  return question => new Promise(done => { waiting.set(++count, done); worker.postMessage({ id: count, question }); });
}

function ok(told) {
  if (told.error) throw Object.assign(new Error(told.error.message), { help: told.error.help });
  return told.ok;
}

// ---- What is shown, and its link ----

const state = { robot: '', text: null, changes: new Map(), kpa: [], data: null, asked: false };
let ask, slow, start, told, before = null, compared = null, baseline = null, finite = null;

const robot = () => ({ name: state.robot, text: state.text, changes: [...state.changes] });

function link() {
  const parts = new URLSearchParams();
  if (state.text) parts.set('scenario', state.text); else parts.set('robot', state.robot);
  parts.set('kpa', state.kpa.join(','));
  if (state.changes.size) parts.set('set', JSON.stringify([...state.changes]));
  if (state.data && !state.data.csv) parts.set('data', state.data.name);
  if (state.asked) parts.set('ask', 'diagnose');
  history.replaceState(null, '', '#' + parts);
}

function linked() {
  const parts = new URLSearchParams(location.hash.slice(1));
  const known = start.robots.some(r => r.name === parts.get('robot'));
  state.text = parts.get('scenario');
  state.robot = state.text ? 'your scenario' : known ? parts.get('robot') : start.robots.find(r => r.name === start.story.robot.replace('-textbook', '')).name;
  try { state.changes = new Map(JSON.parse(parts.get('set') ?? '[]')); } catch { state.changes = new Map(); }
  state.kpa = (parts.get('kpa') ?? '').split(',').filter(Boolean).map(Number);
  const set = start.data.find(d => d.name === parts.get('data'));
  state.data = set ? { name: set.name } : null;
  state.asked = parts.get('ask') === 'diagnose' && !!set;
}

function fault(error) {
  $('fault').hidden = !error;
  $('fault').textContent = error ? error.message + (error.help ? `\n${error.help}` : '') : '';
}

// ---- Pieces ----

function element(tag, values = {}, ...children) {
  const made = Object.assign(document.createElement(tag), values);
  made.append(...children);
  return made;
}

const shown = v => Math.abs(v) >= 1e4 || (v !== 0 && Math.abs(v) < 1e-3) ? v.toExponential(2) : String(+v.toPrecision(3));

/** A slider with its number; wide ranges from 0 are finer near 0. */
function dial({ name, unit, value, low, high, step, set }) {
  const wide = low === 0 && !step, power = wide ? 3 : 1;
  const place = v => ((v - low) / (high - low)) ** (1 / power);
  const input = element('input', { type: 'range', min: step ? low : 0, max: step ? high : 1, step: step || 0.002 });
  input.value = step ? value : place(value);
  const output = element('output', { textContent: `${shown(value)} ${unit === '-' ? '' : unit}` });
  const now = () => step ? +(+input.value).toFixed(6) : low + (high - low) * (+input.value) ** power;
  const turned = last => { output.textContent = `${shown(now())} ${unit === '-' ? '' : unit}`; input.setAttribute('aria-valuetext', output.textContent); set(now(), last); };
  input.oninput = () => turned(false);
  input.onchange = () => turned(true);
  input.setAttribute('aria-valuetext', output.textContent);
  return element('label', { className: 'dial' }, element('span', { textContent: name }), output, input);
}

/** Rows of name, bar and number; bars stay the same elements while the names do. */
function bars(box, rows) {
  const low = Math.min(0, ...rows.map(r => r.value)), high = Math.max(1e-12, ...rows.map(r => r.value));
  const names = rows.map(r => r.name).join('|');
  if (box.dataset.names !== names) {
    box.dataset.names = names;
    box.replaceChildren(...rows.flatMap(row => [element('span', { textContent: row.name }), element('span', { className: 'track' }, element('span', { className: 'fill' })), element('span', { className: 'number' })]));
  }
  rows.forEach((row, i) => {
    const [, track, number] = [...box.children].slice(3 * i, 3 * i + 3), fill = track.firstChild;
    const share = v => 100 * (v - low) / (high - low);
    fill.className = `fill ${row.className ?? ''}`;
    fill.style.left = `${share(Math.min(0, row.value))}%`;
    fill.style.width = `${share(Math.max(0, row.value)) - share(Math.min(0, row.value))}%`;
    number.textContent = row.number;
  });
}

// ---- The drawing ----

const at = ([x, y]) => `${(MM * x).toFixed(2)},${(-MM * y).toFixed(2)}`;
const line = points => `M${points.map(at).join('L')}`;
const outline = sides => `${line(sides[0])}L${[...sides[1]].reverse().map(at).join('L')}Z`;

/** The actuator on the upper side: pouches as lenses of their height, a muscle as a tube of its width at rest. */
function units(own, { start_m, length_m, count, width_m, is_pouch, in_wall }) {
  const side = own.sides[0], most = side.length - 1;
  const on = s => { const f = Math.min(s * most / own.length_m, most), i = Math.min(Math.floor(f), most - 1), t = f - i; return [0, 1].map(k => side[i][k] * (1 - t) + side[i + 1][k] * t); };
  const beside = ([a, b], p, d) => { const l = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1; return [p[0] - d * (b[1] - a[1]) / l, p[1] + d * (b[0] - a[0]) / l]; };
  const paths = [];
  if (!is_pouch) {
    const high = own.p_act_kpa > 0 ? 2 * width_m / Math.PI : 0, n = 48;
    const inner = [...Array(n + 1)].map((_, i) => on(start_m + length_m * i / n));
    const outer = inner.map((p, i) => beside([inner[Math.max(0, i - 1)], inner[Math.min(n, i + 1)]], p, high));
    return [outline([outer, inner])];
  }
  const high = own.height_m ?? 0;
  for (let i = 0; i < count; i++) {
    const [a, b] = [on(start_m + i * length_m), on(start_m + (i + 1) * length_m)], middle = [0, 1].map(k => (a[k] + b[k]) / 2);
    const lift = in_wall ? 0 : high / 2, [from, to] = [a, b].map(p => beside([a, b], p, lift));
    const top = beside([a, b], middle, lift + high), low = beside([a, b], middle, lift - high);
    paths.push(`M${at(from)}Q${at(top)} ${at(to)}Q${at(low)} ${at(from)}Z`);
  }
  return paths;
}

function svg(tag, values) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [key, value] of Object.entries(values)) made.setAttribute(key, value);
  return made;
}

/** Means of the markers at the hold that is nearest to the pressures that are set. */
function nearest() {
  if (!compared) return null;
  const away = h => Math.abs(h.p_act_kpa - state.kpa[0]) + (h.phase === 'unload' ? 0.01 : 0), holds = compared.residual_map.holds;
  const best = holds.reduce((best, h, i) => away(h) < away(holds[best]) ? i : best, 0);
  return { hold: holds[best], points: compared.measured_m[best] };
}

function draw(own) {
  const length = MM * own.length_m, all = [...own.sides.flat(), ...(own.bare?.sides.flat() ?? [])].map(p => [MM * p[0], -MM * p[1]]);
  const bound = (k, pick, least) => pick(least, ...all.map(p => p[k]));
  const x = [bound(0, Math.min, -0.12 * length) - 12, bound(0, Math.max, 1.04 * length) + 12], y = [bound(1, Math.min, -0.62 * length) - 12, bound(1, Math.max, 0.2 * length) + 12];
  const picture = $('shape');
  picture.setAttribute('viewBox', `${x[0]} ${y[0]} ${x[1] - x[0]} ${y[1] - y[0]}`);
  const width = (x[1] - x[0]) / (picture.clientWidth || 600), tall = (y[1] - y[0]) / (picture.clientHeight || 400), pixel = Math.max(width, tall);
  const circle = (className, r) => p => svg('circle', { class: className, cx: MM * p[0], cy: -MM * p[1], r: r * pixel });
  const seen = nearest(), scale = 10 ** Math.floor(Math.log10(length / 2)), left = x[0] + 14 * pixel, low = y[1] - 12 * pixel;
  const label = svg('text', { x: left + 6 * pixel, y: low - 7 * pixel, style: `font-size:${13 * pixel}px` });
  label.textContent = `${scale} mm`;
  picture.replaceChildren(
    svg('line', { class: 'base', x1: 0, x2: 0, y1: -1.5 * MM * own.radius_m, y2: 1.5 * MM * own.radius_m }),
    svg('path', { class: 'own', d: outline(own.sides) }),
    ...units(own, own.units).map(d => svg('path', { class: 'unit', d })),
    ...(own.bare ? [svg('path', { class: 'bare', d: outline(own.bare.sides) })] : []),
    ...(finite ? [svg('path', { class: 'finite', d: finite.map(line).join('') })] : []),
    ...own.markers.map(m => circle('marker', 4)([m.x_mm / MM, m.y_mm / MM])),
    ...(seen?.points ?? []).filter(p => p[0] !== null).map(circle('seen', 3.2)),
    svg('path', { class: 'scale', fill: 'none', d: `M${left},${low}h${scale}m0,${-4 * pixel}v${8 * pixel}m${-scale},0v${-8 * pixel}` }), label);
  $('measured-key').hidden = !seen;
  if (seen) $('measured-at').textContent = `at ${shown(seen.hold.p_act_kpa)} kPa, ${seen.hold.phase}`;
  const tip = ({ tip: { x_mm, y_mm, angle_deg } }) => `tip ${x_mm.toFixed(1)} mm along, ${y_mm.toFixed(1)} mm up, turned by ${angle_deg.toFixed(1)}°`;
  $('tip').textContent = `${tip(own)}${own.bare ? `; bare model: ${own.bare.tip.y_mm.toFixed(1)} mm up` : ''}`;
  $('notes').replaceChildren(...own.notes.map(note => element('li', { textContent: note })));
  bars($('ledger'), own.ledger.map(l => ({ name: l.term.replaceAll('_', ' ') + (l.kind === 'lost' ? ' (lost)' : ''), value: l.energy_mj, number: l.energy_mj.toFixed(2), className: l.energy_mj < 0 ? 'gives' : '' })));
}

let frame = 0, drawnOnce = false;
function predict() {
  frame ||= requestAnimationFrame(() => {
    frame = 0;
    try {
      const own = ok(ask({ ask: 'predict', robot: robot(), actuator_kpa: state.kpa.length ? state.kpa : [0] }));
      fault(null);
      draw(own);
      window.ibr.state = own;
      if (!drawnOnce) { drawnOnce = true; performance.mark('first-shape'); }
    } catch (error) { fault(error); }
  });
}

// ---- Controls ----

/** A value was set by hand. */
function set(changes, last) {
  for (const [place, value] of changes) if (value === null) state.changes.delete(place); else state.changes.set(place, String(value));
  finite = null;
  predict();
  if (last) settled(false);
}

function effect(e) {
  const box = element('input', { type: 'checkbox', checked: e.is_on, name: e.name });
  const dials = element('div');
  const fill = () => dials.replaceChildren(...(box.checked ? e.parameters.map(p => dial({ name: p.meaning, unit: p.unit, value: box.checked && e.is_on ? p.value : p.on, low: p.low, high: p.high, set: (v, last) => set([[p.place, v], ...by_hand()], last) })) : []));
  const by_hand = () => e.was_on ? [] : [[e.basis.place, `"${e.basis.by_hand}"`]];
  box.onchange = () => {
    const on = e.parameters.map(p => [p.place, p.on]), off = e.parameters.map(p => [p.place, p.off]);
    const given = [...e.parameters.map(p => [p.place, null]), [e.basis.place, null]];
    set(box.checked === e.was_on ? given : box.checked ? [...on, ...by_hand()] : off, true);
    e.is_on = box.checked && e.was_on; fill();
  };
  fill();
  return element('div', { className: 'effect' }, element('label', {}, box, element('span', {}, element('span', { textContent: e.words }), element('small', { textContent: e.sentence }))), dials);
}

function controls() {
  const channel = (c, i) => dial({ name: told.channels.length > 1 ? `actuator pressure, channel ${c}` : 'actuator pressure', unit: 'kPa', value: state.kpa[i], low: 0, high: Math.max(2 * Math.max(10, ...told.pressures_kpa), state.kpa[i]), step: 0.1, set: (v, last) => { if (told.channels.length > 1) state.kpa[c] = v; else state.kpa = [v]; finite = null; predict(); if (last) link(); } });
  const turned = ({ dial: d, value }) => dial({ ...d, value, low: Math.min(d.low, value), high: Math.max(d.high, value), set: (v, last) => set([[d.place, v]], last) });
  const pressure = told.dials.filter(d => d.dial.place === 'body.pressure_kpa'), sizes = told.dials.filter(d => !pressure.includes(d));
  $('pressures').replaceChildren(...told.channels.map(channel), ...pressure.map(turned));
  $('sizes').replaceChildren(...sizes.map(turned));
  const groups = [...new Set(told.effects.map(e => e.group))];
  $('effects').replaceChildren(...groups.flatMap(g => [element('h3', { textContent: g }), ...told.effects.filter(e => e.group === g).map(effect)]));
}

/** After a change is complete: text and link, and what is held against data. */
function settled(rebuild) {
  try {
    const fresh = ok(ask({ ask: 'robot', robot: robot() }));
    if (rebuild || !told) { told = fresh; pressures(); controls(); }
    told = { ...fresh, dials: told.dials };
    $('text').textContent = fresh.text;
    $('save').href = `data:application/toml;charset=utf-8,${encodeURIComponent(fresh.text)}`;
    link();
    if (state.data) compare();
  } catch (error) { fault(error); }
}

function pressures() {
  const usual = told.pressures_kpa.at(-1) ?? 0;
  const most = told.channels.length > 1 ? Math.max(...told.channels) + 1 : Math.min(1, told.channels.length);
  state.kpa = [...Array(most)].map((_, i) => Number.isFinite(state.kpa[i]) ? state.kpa[i] : usual);
}

function choose(name, text = null) {
  Object.assign(state, { robot: name, text, changes: new Map(), kpa: [], asked: false });
  before = baseline = compared = finite = null;
  robots();
  settled(true);
  predict();
}

function robots() {
  const own = state.text ? [element('option', { value: '', textContent: state.robot })] : [];
  $('robot').replaceChildren(...own, ...start.robots.map(r => element('option', { value: r.name, textContent: r.title })));
  $('robot').value = state.text ? '' : state.robot;
}

// ---- Measurements ----

let turn = 0;
async function compare() {
  const mine = ++turn;
  const answer = await slow({ ask: 'compare', robot: robot(), data: state.data });
  if (mine !== turn) return;
  try {
    compared = ok(answer);
    baseline ??= compared.error_mm;
    $('compared').hidden = false;
    const mm = v => `${v.toFixed(2)} mm`;
    bars($('error'), [{ name: 'error beyond noise at first', value: baseline, number: mm(baseline), className: 'gives' }, { name: 'error beyond noise now', value: compared.error_mm, number: mm(compared.error_mm), className: 'now' }]);
    $('noise').textContent = `${compared.data}: ${compared.runs} runs. ${compared.noise.sentence}`;
    $('fails').replaceChildren(...[...compared.warnings, ...compared.where_it_fails.slice(0, 3).map(w => w.sentence)].map(s => element('li', { textContent: s })));
    $('residual_map').innerHTML = compared.pictures.residual_map ?? '';
    fault(null);
    predict();
  } catch (error) { compared = null; $('compared').hidden = true; fault(error); }
}

function measured(data) {
  state.data = data;
  state.asked = false;
  baseline = before = null;
  $('diagnosed').hidden = true;
  $('sets').value = data.csv ? '' : data.name;
  link();
  return compare();
}

async function diagnose() {
  $('diagnose').disabled = true;
  $('working').textContent = 'fitting every effect…';
  const began = performance.now();
  before ??= new Map(state.changes);
  const answer = await slow({ ask: 'diagnose', robot: { ...robot(), changes: [...before] }, data: state.data });
  window.ibr.diagnosis_s = (performance.now() - began) / 1e3;
  $('diagnose').disabled = false;
  $('working').textContent = '';
  try { tell(ok(answer)); state.asked = true; link(); fault(null); } catch (error) { fault(error); }
}

function tell(d) {
  window.ibr.diagnosis = d;
  $('diagnosed').hidden = false;
  $('verdict').className = `verdict ${d.verdict === 'effect' ? '' : d.verdict === 'none' || d.verdict === 'too_small' ? 'calm' : 'open'}`;
  $('verdict').replaceChildren(element('p', { className: 'answer', textContent: d.verdict_words }), ...d.summary.map(s => element('p', { textContent: s })));
  $('cautions').replaceChildren(...d.warnings.map(w => element('li', { textContent: w })));
  $('missing_moment').innerHTML = d.pictures.missing_moment ?? '';
  $('candidates-figure').innerHTML = d.pictures.candidates ?? '';
  $('candidates').replaceChildren(...d.candidates.slice(0, 8).map(candidate));
}

function candidate(c) {
  const is_on = c.changes.every(([place, value]) => state.changes.get(place) === value);
  const box = element('input', { type: 'checkbox', checked: is_on, name: c.name });
  box.onchange = () => {
    for (const other of $('candidates').querySelectorAll('input')) if (other !== box) other.checked = false;
    state.changes = new Map([...before, ...(box.checked ? c.changes : [])]);
    settled(true);
    predict();
  };
  const rows = element('div', { className: 'bars' });
  const alike = { stated: 'cannot be told apart from the best', attempt: 'not enough', other: 'fits worse' }[c.standing] ?? c.standing;
  bars(rows, [{ name: 'before', value: c.before_mm, number: `${c.before_mm.toFixed(2)} mm`, className: 'gives' }, { name: 'with it', value: c.after_mm, number: `${c.after_mm.toFixed(2)} mm`, className: 'now' }]);
  return element('div', { className: 'candidate' }, element('label', {}, box, element('span', {}, element('strong', { textContent: c.words }), ` (${alike})`)), element('p', { textContent: `${c.values}. ${c.sentence} To check: ${c.remedy}` }), rows);
}

async function dropped(files) {
  const texts = await Promise.all([...files].map(async f => ({ name: f.name, text: await f.text() })));
  const is_robot = ({ name, text }) => name.endsWith('.toml') && /^\s*\[body\]/m.test(text);
  const own = texts.find(is_robot), csv = texts.find(f => f.name.endsWith('.csv')), about = texts.find(f => f.name.endsWith('.toml') && !is_robot(f));
  if (own) choose(own.name, own.text);
  if (csv) await measured({ name: csv.name, csv: csv.text, about: about?.text });
  if (!own && !csv) fault(Object.assign(new Error('Neither a scenario nor a marker table'), { help: 'Give a .csv of markers, with its about.toml if there is one, or a .toml with [body].' }));
}

function listen() {
  $('robot').onchange = () => $('robot').value && choose($('robot').value);
  $('share').onclick = async () => {
    const own = state.data?.csv ? ' The table itself is not in it.' : '';
    try { await navigator.clipboard.writeText(location.href); $('said').textContent = `Copied.${own}`; } catch { $('said').textContent = `Copy the address of this page.${own}`; }
  };
  const every = on => { for (const box of $('effects').querySelectorAll('.effect > label input')) if (box.checked !== on(box)) box.click(); };
  $('bare').onclick = () => { every(() => false); set([['body.bending_stiffness_nm2', 0]], true); };
  $('given').onclick = () => { state.changes = new Map(); settled(true); predict(); };
  $('story').onclick = () => { choose(start.story.robot); measured({ name: start.story.data }); };
  $('sets').replaceChildren(element('option', { value: '', textContent: 'choose a set' }), ...start.data.map(d => element('option', { value: d.name, textContent: d.title })));
  $('sets').onchange = () => $('sets').value && measured({ name: $('sets').value });
  $('files').onchange = () => dropped($('files').files);
  $('diagnose').onclick = diagnose;
  const drop = $('drop');
  document.ondragover = event => { event.preventDefault(); drop.classList.add('over'); };
  document.ondragleave = () => drop.classList.remove('over');
  document.ondrop = event => { event.preventDefault(); drop.classList.remove('over'); dropped(event.dataTransfer.files); };
  window.onhashchange = restored;
  window.onresize = predict;
}

// ---- Finite elements, where `ibr studio` is behind the page ----

async function finite_elements(start) {
  let run = await (await fetch('run', start && { method: 'POST', body: JSON.stringify(start) })).json();
  while (run.state === 'runs') {
    $('running').hidden = $('stop').hidden = false;
    $('running').value = run.share ?? 0;
    $('run-said').textContent = run.what;
    await new Promise(done => setTimeout(done, 250));
    run = await (await fetch('run')).json();
  }
  $('running').hidden = $('stop').hidden = true;
  $('run-said').textContent = '';
  if (run.state === 'failed') fault(run);
  if (run.state !== 'done') return;
  finite = [run.line_m];
  const [x, y] = run.line_m.at(-1).map(v => (MM * v).toFixed(1));
  $('run-said').textContent = `Green line: ${run.elements} elements at ${shown(run.actuator_kpa)} kPa, ${run.cpu_s.toFixed(1)} CPU s; tip ${x} mm along, ${y} mm up, turned by ${run.angle_deg.toFixed(1)}°. Coarse: 4 mm. Its energy balance misses ${(100 * run.missing_share).toFixed(2)} %.`;
  predict();
}

function studio() {
  if (!document.querySelector('meta[name=ibr-studio]')) return;
  $('finite').hidden = false;
  const guarded = start => finite_elements(start).catch(error => fault(Object.assign(error, { help: 'Is ibr studio still running?' }))).finally(() => { $('run').disabled = false; });
  $('run').onclick = () => { $('run').disabled = true; guarded({ name: state.robot, text: told.text, actuator_kpa: state.kpa[0] ?? 0 }); };
  $('stop').onclick = () => fetch('stop', { method: 'POST' });
  guarded();
}

async function restored() {
  linked();
  const asked = state.asked;
  before = baseline = compared = finite = null;
  $('diagnosed').hidden = $('compared').hidden = true;
  robots();
  settled(true);
  predict();
  if (asked) { state.asked = true; await diagnose(); }
}

async function main() {
  window.ibr = {};
  const module = await unpacked();
  ask = await opened(module);
  slow = worked(module);
  start = ok(ask({ ask: 'start' }));
  const [light, dark] = start.colours;
  document.head.append(element('style', { textContent: `:root{${light}}@media (prefers-color-scheme:dark){:root{${dark}}}` }));
  $('version').textContent = `ibr ${start.version}`;
  window.ibr.ask = ask;
  listen();
  studio();
  await restored();
}

main().catch(fault);
