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
    const mm = (v) => `${v.toFixed(2)} mm`;
    bars($('error'), [
      { name: 'error beyond noise at first', value: baseline, number: mm(baseline), className: 'gives' },
      { name: 'error beyond noise now', value: compared.error_mm, number: mm(compared.error_mm), className: 'now' },
    ]);
    $('now').textContent = `Error beyond noise: ${mm(baseline)} at first, ${mm(compared.error_mm)} now.`;
    $('noise').textContent = `${compared.data}: ${compared.runs} runs. ${compared.noise.sentence}`;
    $('fails').replaceChildren(
      ...[...compared.warnings, ...compared.where_it_fails.slice(0, 3).map((w) => w.sentence)].map((s) =>
        element('li', { textContent: s }),
      ),
    );
    $('residual_map').innerHTML = compared.pictures.residual_map ?? '';
    fault(null);
    predict();
  } catch (error) {
    compared = null;
    $('compared').hidden = true;
    fault(error);
  }
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

/** Asks what the robot lacks as it is now, or as it was when the link was made. */
async function diagnose(of = new Map(state.changes)) {
  $('diagnose').disabled = true;
  $('working').textContent = 'fitting every effect…';
  const began = performance.now();
  before = of;
  const answer = await slow({ ask: 'diagnose', robot: { ...robot(), changes: [...before] }, data: state.data });
  window.ibr.diagnosis_s = (performance.now() - began) / 1e3;
  $('diagnose').disabled = false;
  $('working').textContent = '';
  try {
    tell(ok(answer));
    state.asked = true;
    link();
    fault(null);
  } catch (error) {
    fault(error);
  }
}

function tell(d) {
  window.ibr.diagnosis = d;
  if (baseline === null || state.changes.size > before.size) baseline = d.base.systematic_nominal_mm;
  $('diagnosed').hidden = false;
  $('verdict').className =
    `verdict ${d.verdict === 'effect' ? '' : d.verdict === 'none' ? 'calm' : 'open'}`;
  $('verdict').replaceChildren(
    element('p', { className: 'answer', textContent: `Verdict: ${d.verdict_words}` }),
    ...d.summary.map((s) => element('p', { textContent: s })),
  );
  $('cautions').replaceChildren(...d.warnings.map((w) => element('li', { textContent: w })));
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
  const alike =
    { stated: 'fits as well as the best', attempt: 'not enough', other: 'fits worse' }[c.standing] ??
    c.standing;
  bars(rows, [
    { name: 'before', value: c.before_mm, number: `${c.before_mm.toFixed(2)} mm`, className: 'gives' },
    { name: 'with it', value: c.after_mm, number: `${c.after_mm.toFixed(2)} mm`, className: 'now' },
  ]);
  return element(
    'div',
    { className: 'candidate' },
    element('label', {}, box, element('span', {}, element('strong', { textContent: c.words }), ` (${alike})`)),
    element('p', { textContent: `${c.values}. ${c.sentence} To check: ${c.remedy}` }),
    rows,
  );
}

async function dropped(files) {
  const texts = await Promise.all([...files].map(async (f) => ({ name: f.name, text: await f.text() })));
  const is_robot = ({ name, text }) => name.endsWith('.toml') && /^\s*\[body\]/m.test(text);
  const own = texts.find(is_robot),
    csv = texts.find((f) => f.name.endsWith('.csv')),
    about = texts.find((f) => f.name.endsWith('.toml') && !is_robot(f));
  if (own) choose(own.name, own.text);
  if (csv) await measured({ name: csv.name, csv: csv.text, about: about?.text });
  if (!own && !csv)
    fault(
      Object.assign(new Error('Neither a scenario nor a marker table'), {
        help: 'Give a .csv of markers, with its about.toml if there is one, or a .toml with [body].',
      }),
    );
}

// ---- Finite elements, where `ibr studio` is behind the page ----

async function finite_elements(start) {
  let run = await (await fetch('run', start && { method: 'POST', body: JSON.stringify(start) })).json();
  while (run.state === 'runs') {
    $('running').hidden = $('stop').hidden = false;
    $('running').value = run.share ?? 0;
    $('run-said').textContent = run.what;
    await new Promise((done) => setTimeout(done, 250));
    run = await (await fetch('run')).json();
  }
  $('running').hidden = $('stop').hidden = true;
  $('run-said').textContent = run.state === 'stopped' ? 'Stopped.' : '';
  if (run.state === 'failed') fault(run);
  if (run.state !== 'done') return;
  finite = [run.line_m];
  const [x, y] = run.line_m.at(-1).map((v) => (MM * v).toFixed(1));
  $('run-said').textContent =
    `Green line: ${run.elements} elements at ${shown(run.actuator_kpa)} kPa, ${run.cpu_s.toFixed(1)} CPU s; tip ${x} mm along, ${y} mm up, turned by ${run.angle_deg.toFixed(1)}°. Coarse: 4 mm. Its energy balance misses ${(100 * run.missing_share).toFixed(2)} %.`;
  predict();
}

const is_studio = () => !!document.querySelector('meta[name=ibr-studio]');

function studio() {
  if (!is_studio()) return;
  const guarded = (start) =>
    finite_elements(start)
      .catch((error) => fault(Object.assign(error, { help: 'Is ibr studio still running?' })))
      .finally(() => {
        $('run').disabled = false;
      });
  $('run').onclick = () => {
    $('run').disabled = true;
    guarded({ name: state.robot, text: told.text, actuator_kpa: state.kpa[0] ?? 0 });
  };
  $('stop').onclick = () => fetch('stop', { method: 'POST' });
  guarded();
}
