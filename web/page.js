// ---- What is shown, and its link ----

const state = { robot: '', text: null, changes: new Map(), kpa: [], data: null, asked: false };
let ask,
  slow,
  start,
  told,
  before = null,
  compared = null,
  baseline = null,
  finite = null;

const robot = () => ({ name: state.robot, text: state.text, changes: [...state.changes] });

function link() {
  const parts = new URLSearchParams();
  if (state.text) parts.set('scenario', state.text);
  else parts.set('robot', state.robot);
  parts.set('kpa', state.kpa.join(','));
  if (state.changes.size) parts.set('set', JSON.stringify([...state.changes]));
  if (state.data && !state.data.csv) parts.set('data', state.data.name);
  if (state.asked) {
    parts.set('ask', 'diagnose');
    parts.set('of', JSON.stringify([...before]));
  }
  history.replaceState(null, '', '#' + parts);
}

function linked() {
  const parts = new URLSearchParams(location.hash.slice(1));
  const known = start.robots.some((r) => r.name === parts.get('robot'));
  state.text = parts.get('scenario');
  state.robot = state.text
    ? 'your scenario'
    : known
      ? parts.get('robot')
      : start.robots.find((r) => r.name === start.story.robot.replace('-textbook', '')).name;
  const changes = (name) => {
    try {
      return new Map(JSON.parse(parts.get(name) ?? '[]'));
    } catch {
      return new Map();
    }
  };
  state.changes = changes('set');
  state.kpa = (parts.get('kpa') ?? '').split(',').filter(Boolean).map(Number);
  const set = start.data.find((d) => d.name === parts.get('data'));
  state.data = set ? { name: set.name } : null;
  state.asked = parts.get('ask') === 'diagnose' && !!set;
  before = state.asked ? changes('of') : null;
}

function fault(error) {
  $('fault').hidden = !error;
  $('fault').textContent = error ? error.message + (error.help ? `\n${error.help}` : '') : '';
}

let frame = 0,
  drawnOnce = false;
function predict() {
  frame ||= requestAnimationFrame(() => {
    frame = 0;
    try {
      const own = ok(ask({ ask: 'predict', robot: robot(), actuator_kpa: state.kpa.length ? state.kpa : [0] }));
      fault(null);
      draw(own);
      window.ibr.state = own;
      if (!drawnOnce) {
        drawnOnce = true;
        performance.mark('first-shape');
      }
    } catch (error) {
      fault(error);
    }
  });
}

// ---- Controls ----

/** A value was set by hand. */
function set(changes, last) {
  for (const [place, value] of changes)
    if (value === null) state.changes.delete(place);
    else state.changes.set(place, String(value));
  finite = null;
  predict();
  if (last) settled(false);
}

function effect(e) {
  const box = element('input', { type: 'checkbox', checked: e.is_on, name: e.name });
  const dials = element('div');
  const fill = () =>
    dials.replaceChildren(
      ...(box.checked
        ? e.parameters.map((p) =>
            dial({
              name: p.meaning,
              unit: p.unit,
              value: box.checked && e.is_on ? p.value : p.on,
              low: p.low,
              high: p.high,
              set: (v, last) => set([[p.place, v], ...by_hand()], last),
            }),
          )
        : []),
    );
  const by_hand = () => (e.was_on ? [] : [[e.basis.place, `"${e.basis.by_hand}"`]]);
  box.onchange = () => {
    const on = e.parameters.map((p) => [p.place, p.on]),
      off = e.parameters.map((p) => [p.place, p.off]);
    const given = [...e.parameters.map((p) => [p.place, null]), [e.basis.place, null]];
    set(box.checked === e.was_on ? given : box.checked ? [...on, ...by_hand()] : off, true);
    e.is_on = box.checked && e.was_on;
    fill();
  };
  fill();
  return element(
    'div',
    { className: 'effect' },
    element(
      'label',
      {},
      box,
      element('span', {}, element('span', { textContent: e.words }), element('small', { textContent: e.sentence })),
    ),
    dials,
  );
}

function controls() {
  const channel = (c) =>
    dial({
      name: told.channels.length > 1 ? `actuator pressure, channel ${c}` : 'actuator pressure',
      unit: 'kPa',
      value: state.kpa[told.channels.length > 1 ? c : 0],
      low: 0,
      high: Math.max(2 * Math.max(10, ...told.pressures_kpa), ...state.kpa),
      step: 0.1,
      set: (v, last) => {
        if (told.channels.length > 1) state.kpa[c] = v;
        else state.kpa = [v];
        finite = null;
        predict();
        if (last) link();
      },
    });
  const turned = ({ dial: d, value }) =>
    dial({
      ...d,
      value,
      low: Math.min(d.low, value),
      high: Math.max(d.high, value),
      set: (v, last) => set([[d.place, v]], last),
    });
  const pressure = told.dials.filter((d) => d.dial.place === 'body.pressure_kpa'),
    sizes = told.dials.filter((d) => !pressure.includes(d));
  $('pressures').replaceChildren(...told.channels.map(channel), ...pressure.map(turned));
  $('sizes').replaceChildren(...sizes.map(turned));
  const groups = [...new Set(told.effects.map((e) => e.group))];
  $('effects').replaceChildren(
    ...groups.flatMap((g) => [
      element('h3', { textContent: g }),
      ...told.effects.filter((e) => e.group === g).map(effect),
    ]),
  );
}

/** After a change is complete: text and link, and the data it is compared with. */
function settled(rebuild) {
  try {
    const fresh = ok(ask({ ask: 'robot', robot: robot() }));
    if (rebuild || !told) {
      told = fresh;
      pressures();
      controls();
    }
    told = { ...fresh, dials: told.dials };
    planar(!fresh.is_spatial);
    $('text').textContent = fresh.text;
    $('save').href = `data:application/toml;charset=utf-8,${encodeURIComponent(fresh.text)}`;
    link();
    if (state.data && !fresh.is_spatial) compare();
  } catch (error) {
    fault(error);
  }
}

/** What is built for planar robots alone is there for them alone. */
function planar(is_planar) {
  $('measurements').hidden = !is_planar;
  $('finite').hidden = !is_planar || !is_studio();
  $('far-key').hidden = is_planar;
}

function pressures() {
  const usual = told.pressures_kpa.at(-1) ?? 0;
  const most = told.channels.length > 1 ? Math.max(...told.channels) + 1 : Math.min(1, told.channels.length);
  const is_fed = (i) => told.channels.length === 1 || told.channels.includes(i);
  state.kpa = [...Array(most)].map((_, i) => (is_fed(i) ? (Number.isFinite(state.kpa[i]) ? state.kpa[i] : usual) : 0));
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
  $('robot').replaceChildren(
    ...own,
    ...start.robots.map((r) => element('option', { value: r.name, textContent: r.title })),
  );
  $('robot').value = state.text ? '' : state.robot;
}

// ---- The story, from the panels of `ibr demo` ----

function table({ heads, rows }) {
  const row = (cells, kind) => element('tr', {}, ...cells.map((c) => element(kind, { textContent: c })));
  const head = row(
    heads.map((h) => h[0]),
    'th',
  );
  return element('div', { className: 'table' }, element('table', {}, head, ...rows.map((cells) => row(cells, 'td'))));
}

/** In a worker of its own, so that no comparison waits for it. */
async function story(module) {
  const { panels, pictures } = ok(await worked(module)({ ask: 'demo' }));
  const panel = (p, k) => {
    const figure = element('figure');
    figure.innerHTML = pictures[p.picture] ?? '';
    figure.append(element('figcaption', { className: 'caption', textContent: p.caption }));
    const lead = element('p', { textContent: p.lead });
    const title = element('h2', { textContent: `${k + 1}. ${p.title}` });
    return element('article', {}, title, lead, figure, ...(p.table ? [table(p.table)] : []));
  };
  $('panels').replaceChildren(...panels.map(panel));
  window.ibr.panels = panels.length;
}

// ---- Start ----

function listen() {
  $('robot').onchange = () => $('robot').value && choose($('robot').value);
  $('share').onclick = async () => {
    const own = state.data?.csv ? ' The table itself is not in it.' : '';
    try {
      await navigator.clipboard.writeText(location.href);
      $('said').textContent = `Copied.${own}`;
    } catch {
      $('said').textContent = `Copy the address of this page.${own}`;
    }
  };
  const every = (on) => {
    for (const box of $('effects').querySelectorAll('.effect > label input')) if (box.checked !== on(box)) box.click();
  };
  $('bare').onclick = () => {
    every(() => false);
    set([['body.bending_stiffness_nm2', 0]], true);
  };
  $('given').onclick = () => {
    state.changes = new Map();
    settled(true);
    predict();
  };
  $('story').onclick = () => {
    choose(start.story.robot);
    measured({ name: start.story.data });
  };
  $('sets').replaceChildren(
    element('option', { value: '', textContent: 'choose a set' }),
    ...start.data.map((d) => element('option', { value: d.name, textContent: d.title })),
  );
  $('sets').onchange = () => $('sets').value && measured({ name: $('sets').value });
  $('files').onchange = () => dropped($('files').files);
  $('diagnose').onclick = () => diagnose();
  const drop = $('drop');
  document.ondragover = (event) => {
    event.preventDefault();
    drop.classList.add('over');
  };
  document.ondragleave = () => drop.classList.remove('over');
  document.ondrop = (event) => {
    event.preventDefault();
    drop.classList.remove('over');
    dropped(event.dataTransfer.files);
  };
  window.onhashchange = restored;
  window.onresize = predict;
}

async function restored() {
  linked();
  baseline = compared = finite = null;
  $('diagnosed').hidden = $('compared').hidden = true;
  robots();
  settled(true);
  predict();
  if (state.asked) await diagnose(before);
}

async function main() {
  window.ibr = {};
  const module = await unpacked();
  ask = await opened(module);
  slow = worked(module);
  start = ok(ask({ ask: 'start' }));
  const [light, dark] = start.colours;
  document.head.append(
    element('style', { textContent: `:root{${light}}@media (prefers-color-scheme:dark){:root{${dark}}}` }),
  );
  $('version').textContent = `ibr ${start.version}`;
  window.ibr.ask = ask;
  listen();
  studio();
  story(module).catch(fault);
  await restored();
}

main().catch(fault);
