// Pieces of the page and the drawing of a robot.

// ---- Pieces ----

function element(tag, values = {}, ...children) {
  const made = Object.assign(document.createElement(tag), values);
  made.append(...children);
  return made;
}

/** A number of three digits. */
const shown = (v) =>
  Math.abs(v) >= 1e4 || (v !== 0 && Math.abs(v) < 1e-3) ? v.toExponential(2) : String(+v.toPrecision(3));

/** A slider with its number; wide ranges from 0 are finer near 0. */
function dial({ name, unit, value, low, high, step, set }) {
  const wide = low === 0 && !step,
    power = wide ? 3 : 1;
  const place = (v) => ((v - low) / (high - low)) ** (1 / power);
  const input = element('input', { type: 'range', min: step ? low : 0, max: step ? high : 1, step: step || 0.002 });
  input.value = step ? value : place(value);
  const output = element('span', { className: 'value', textContent: `${shown(value)} ${unit === '-' ? '' : unit}` });
  const now = () => (step ? +(+input.value).toFixed(6) : low + (high - low) * (+input.value) ** power);
  const turned = (last) => {
    output.textContent = `${shown(now())} ${unit === '-' ? '' : unit}`;
    input.setAttribute('aria-valuetext', output.textContent);
    set(now(), last);
  };
  input.oninput = () => turned(false);
  input.onchange = () => turned(true);
  input.setAttribute('aria-valuetext', output.textContent);
  return element('label', { className: 'dial' }, element('span', { textContent: name }), output, input);
}

/** Rows of name, bar and number; bars stay the same elements while the names do. */
function bars(box, rows) {
  const low = Math.min(0, ...rows.map((r) => r.value)),
    high = Math.max(1e-12, ...rows.map((r) => r.value));
  const names = rows.map((r) => r.name).join('|');
  if (box.dataset.names !== names) {
    box.dataset.names = names;
    box.replaceChildren(
      ...rows.flatMap((row) => [
        element('span', { textContent: row.name }),
        element('span', { className: 'track' }, element('span', { className: 'fill' })),
        element('span', { className: 'number' }),
      ]),
    );
  }
  rows.forEach((row, i) => {
    const [, track, number] = [...box.children].slice(3 * i, 3 * i + 3),
      fill = track.firstChild;
    const share = (v) => (100 * (v - low)) / (high - low);
    fill.className = `fill ${row.className ?? ''}`;
    fill.style.left = `${share(Math.min(0, row.value))}%`;
    fill.style.width = `${share(Math.max(0, row.value)) - share(Math.min(0, row.value))}%`;
    number.textContent = row.number;
  });
}

// ---- The drawing ----

const at = ([x, y]) => `${(MM * x).toFixed(2)},${(-MM * y).toFixed(2)}`;
const line = (points) => `M${points.map(at).join('L')}`;
const outline = (sides) => `${line(sides[0])}L${[...sides[1]].reverse().map(at).join('L')}Z`;

/** The actuator on the upper side: pouches as lenses of their height, a muscle as a tube of its width at rest. */
function units(own, { start_m, length_m, count, width_m, is_pouch, in_wall }) {
  const side = own.sides[0],
    most = side.length - 1;
  const on = (s) => {
    const f = Math.min((s * most) / own.length_m, most),
      i = Math.min(Math.floor(f), most - 1),
      t = f - i;
    return [0, 1].map((k) => side[i][k] * (1 - t) + side[i + 1][k] * t);
  };
  const beside = ([a, b], p, d) => {
    const l = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    return [p[0] - (d * (b[1] - a[1])) / l, p[1] + (d * (b[0] - a[0])) / l];
  };
  const paths = [];
  if (!is_pouch) {
    const high = own.p_act_kpa > 0 ? (2 * width_m) / Math.PI : 0,
      n = 48;
    const inner = [...Array(n + 1)].map((_, i) => on(start_m + (length_m * i) / n));
    const outer = inner.map((p, i) => beside([inner[Math.max(0, i - 1)], inner[Math.min(n, i + 1)]], p, high));
    return [outline([outer, inner])];
  }
  const high = own.height_m ?? 0;
  for (let i = 0; i < count; i++) {
    const [a, b] = [on(start_m + i * length_m), on(start_m + (i + 1) * length_m)],
      middle = [0, 1].map((k) => (a[k] + b[k]) / 2);
    const lift = in_wall ? 0 : high / 2,
      [from, to] = [a, b].map((p) => beside([a, b], p, lift));
    const top = beside([a, b], middle, lift + high),
      low = beside([a, b], middle, lift - high);
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
  const away = (h) => Math.abs(h.p_act_kpa - state.kpa[0]) + (h.phase === 'unload' ? 0.01 : 0),
    holds = compared.residual_map.holds;
  const best = holds.reduce((best, h, i) => (away(h) < away(holds[best]) ? i : best), 0);
  return { hold: holds[best], points: compared.measured_m[best] };
}

function draw(own) {
  const length = MM * own.length_m,
    all = [...own.sides.flat(), ...(own.bare?.sides.flat() ?? [])].map((p) => [MM * p[0], -MM * p[1]]);
  const bound = (k, pick, least) => pick(least, ...all.map((p) => p[k]));
  const x = [bound(0, Math.min, -0.12 * length) - 12, bound(0, Math.max, 1.04 * length) + 12],
    y = [bound(1, Math.min, -0.62 * length) - 12, bound(1, Math.max, 0.2 * length) + 12];
  const picture = $('shape');
  picture.setAttribute('viewBox', `${x[0]} ${y[0]} ${x[1] - x[0]} ${y[1] - y[0]}`);
  const width = (x[1] - x[0]) / (picture.clientWidth || 600),
    tall = (y[1] - y[0]) / (picture.clientHeight || 400),
    pixel = Math.max(width, tall);
  const circle = (className, r) => (p) =>
    svg('circle', { class: className, cx: MM * p[0], cy: -MM * p[1], r: r * pixel });
  const seen = nearest(),
    scale = 10 ** Math.floor(Math.log10(length / 2)),
    left = x[1] - 14 * pixel - scale,
    low = y[1] - 12 * pixel;
  const label = svg('text', { x: left + 6 * pixel, y: low - 7 * pixel, style: `font-size:${13 * pixel}px` });
  label.textContent = `${scale} mm`;
  picture.replaceChildren(
    svg('line', { class: 'base', x1: 0, x2: 0, y1: -1.5 * MM * own.radius_m, y2: 1.5 * MM * own.radius_m }),
    svg('path', { class: 'own', d: outline(own.sides) }),
    ...units(own, own.units).map((d) => svg('path', { class: 'unit', d })),
    ...(own.bare ? [svg('path', { class: 'bare', d: outline(own.bare.sides) })] : []),
    ...(finite ? [svg('path', { class: 'finite', d: finite.map(line).join('') })] : []),
    ...own.markers.map((m) => circle('marker', 4)([m.x_mm / MM, m.y_mm / MM])),
    ...(seen?.points ?? []).filter((p) => p[0] !== null).map(circle('seen', 3.2)),
    svg('path', {
      class: 'scale',
      fill: 'none',
      d: `M${left},${low}h${scale}m0,${-4 * pixel}v${8 * pixel}m${-scale},0v${-8 * pixel}`,
    }),
    label,
  );
  $('measured-key').hidden = !seen;
  if (seen) $('measured-at').textContent = `at ${shown(seen.hold.p_act_kpa)} kPa, ${seen.hold.phase}`;
  const tip = ({ tip: { x_mm, y_mm, angle_deg } }) =>
    `tip ${x_mm.toFixed(1)} mm along, ${y_mm.toFixed(1)} mm up, turned by ${angle_deg.toFixed(1)}°`;
  $('tip').textContent = `${tip(own)}${own.bare ? `; bare model: ${own.bare.tip.y_mm.toFixed(1)} mm up` : ''}`;
  $('notes').replaceChildren(...own.notes.map((note) => element('li', { textContent: note })));
  bars(
    $('ledger'),
    own.ledger.map((l) => ({
      name: l.term.replaceAll('_', ' ') + (l.kind === 'lost' ? ' (lost)' : ''),
      value: l.energy_mj,
      number: l.energy_mj.toFixed(Math.abs(l.energy_mj) < 100 ? 2 : 0).replace('-', '−'),
      className: l.energy_mj < 0 ? 'gives' : '',
    })),
  );
}
