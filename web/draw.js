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

/** What a planar robot shows: its one side. */
function side(own) {
  const seen = nearest();
  return {
    own: outline(own.sides),
    bare: own.bare && outline(own.bare.sides),
    units: units(own, own.units).map((d) => ({ d, is_near: true })),
    markers: own.markers.map((m) => [m.x_mm / MM, m.y_mm / MM]),
    seen: (seen?.points ?? []).filter((p) => p[0] !== null),
    points: [...own.sides.flat(), ...(own.bare?.sides.flat() ?? [])],
  };
}

/** What a robot with strips round the body shows to who looks along z, and along y. */
function sides(own) {
  const closed = (points) => `${line(points)}Z`;
  return own.views.map((view, i) => {
    const bare = own.bare?.views[i];
    return {
      axis: view.axis,
      own: outline(view.sides),
      bare: bare && outline(bare.sides),
      ring: { d: closed(view.ring), is_near: view.is_ring_near },
      units: view.units.map(({ outline, is_near }) => ({ d: closed(outline), is_near })),
      markers: own.markers.map((m) => [m.x_mm / MM, m[`${view.axis}_mm`] / MM]),
      seen: [],
      points: [...view.sides.flat(), ...view.units.flatMap((u) => u.outline), ...(bare?.sides.flat() ?? [])],
    };
  });
}

/** Words at a place, of a size on the screen. */
function words(text, x, y, pixel, anchor = 'start') {
  const label = svg('text', { x, y, style: `font-size:${13 * pixel}px`, 'text-anchor': anchor });
  label.textContent = text;
  return label;
}

/** Both axes in the lower left corner of a view. */
function axes(axis, x, y, pixel) {
  const [left, low, long, head] = [x + 14 * pixel, y - 14 * pixel, 26 * pixel, 4 * pixel];
  const d = `M${left},${low - long}v${long}h${long}m${-head},${-head}l${head},${head}l${-head},${head}M${left - head},${low - long + head}l${head},${-head}l${head},${head}`;
  return [
    svg('path', { class: 'scale', fill: 'none', d }),
    words('x', left + long + 5 * pixel, low + 4 * pixel, pixel),
    words(axis, left, low - long - 6 * pixel, pixel, 'middle'),
  ];
}

/** Where the tip is, in words. */
function tip({ views, tip: { x_mm, y_mm, z_mm, angle_deg }, bare }) {
  const mm = (v) =>
    v
      .toFixed(1)
      .replace(/^-(0\.0)$/, '$1')
      .replace('-', '−');
  if (!views) {
    const other = bare ? `; bare model: ${bare.tip.y_mm.toFixed(1)} mm up` : '';
    return `tip ${x_mm.toFixed(1)} mm along, ${y_mm.toFixed(1)} mm up, turned by ${angle_deg.toFixed(1)}°${other}`;
  }
  const other = bare ? `; bare model: y ${mm(bare.tip.y_mm)} mm, z ${mm(bare.tip.z_mm)} mm` : '';
  return `tip x ${mm(x_mm)} mm, y ${mm(y_mm)} mm, z ${mm(z_mm)} mm, bent by ${mm(angle_deg)}°${other}`;
}

function draw(own) {
  const length = MM * own.length_m,
    views = own.views ? sides(own) : [side(own)],
    all = views.flatMap((view) => view.points).map((p) => [MM * p[0], -MM * p[1]]);
  const bound = (k, pick, least) => pick(least, ...all.map((p) => p[k]));
  const x = [bound(0, Math.min, -0.12 * length) - 12, bound(0, Math.max, 1.04 * length) + 12],
    y = [bound(1, Math.min, (own.views ? -0.45 : -0.62) * length) - 12, bound(1, Math.max, 0.2 * length) + 12];
  const picture = $('shape'),
    [wide, high] = [x[1] - x[0], y[1] - y[0]],
    room = [picture.clientWidth || 600, picture.clientHeight || 400],
    pixels = (n, m) => Math.max((n * wide) / room[0], (m * high) / room[1]);
  // Two views stand beside or above each other, as they are larger.
  const is_row = pixels(views.length, 1) <= pixels(1, views.length),
    [columns, rows] = is_row ? [views.length, 1] : [1, views.length],
    pixel = pixels(columns, rows);
  picture.setAttribute('viewBox', `${x[0]} ${y[0]} ${columns * wide} ${rows * high}`);
  const circle = (className, r) => (p) =>
    svg('circle', { class: className, cx: MM * p[0], cy: -MM * p[1], r: r * pixel });
  const unit = ({ d }) => svg('path', { class: 'unit', d });
  const drawn = (view, i) => {
    const group = svg('g', { transform: `translate(${is_row ? i * wide : 0},${is_row ? 0 : i * high})` }),
      ring = view.ring ? [svg('path', { class: 'ring', d: view.ring.d })] : [];
    group.append(
      svg('line', { class: 'base', x1: 0, x2: 0, y1: -1.5 * MM * own.radius_m, y2: 1.5 * MM * own.radius_m }),
      ...(view.ring?.is_near ? [] : ring),
      ...view.units.filter((u) => !u.is_near).map(unit),
      svg('path', { class: own.views ? 'own clear' : 'own', d: view.own }),
      ...(view.ring?.is_near ? ring : []),
      ...view.units.filter((u) => u.is_near).map(unit),
      ...(view.bare ? [svg('path', { class: 'bare', d: view.bare })] : []),
      ...(finite ? [svg('path', { class: 'finite', d: finite.map(line).join('') })] : []),
      ...view.markers.map(circle('marker', 4)),
      ...view.seen.map(circle('seen', 3.2)),
      ...(view.axis ? axes(view.axis, x[0], y[1], pixel) : []),
    );
    return group;
  };
  const scale = 10 ** Math.floor(Math.log10(length / 2)),
    left = x[0] + columns * wide - 14 * pixel - scale,
    low = y[0] + rows * high - 12 * pixel;
  picture.replaceChildren(
    ...views.map(drawn),
    svg('path', {
      class: 'scale',
      fill: 'none',
      d: `M${left},${low}h${scale}m0,${-4 * pixel}v${8 * pixel}m${-scale},0v${-8 * pixel}`,
    }),
    words(`${scale} mm`, left + 6 * pixel, low - 7 * pixel, pixel),
  );
  picture.setAttribute('aria-label', `The robot, seen from ${own.views ? 'two sides' : 'its side'}`);
  const seen = own.views ? null : nearest();
  $('measured-key').hidden = !seen;
  if (seen) $('measured-at').textContent = `at ${shown(seen.hold.p_act_kpa)} kPa, ${seen.hold.phase}`;
  $('tip').textContent = tip(own);
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
