// The page of web/dist/ibr.html in a browser: its numbers are the program's, its story can be clicked through, nothing leaves it.
// node web/test.mjs IBR CHROMIUM FOLDER, the folder for pictures; playwright-core is found in FOLDER/node_modules.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';

const [ibr, executablePath, folder] = process.argv.slice(2).map((path) => resolve(path));
const { chromium } = createRequire(join(folder, 'x.js'))('playwright-core');
const file = resolve('web/dist/ibr.html'),
  url = pathToFileURL(file).href;
const scratch = mkdtempSync(join(tmpdir(), 'ibr-web-'));
const native = (...args) =>
  JSON.parse(execFileSync(ibr, ['--json', ...args], { encoding: 'utf8', maxBuffer: 1 << 28 }));
const flags = [
  '--no-sandbox',
  '--disable-gpu',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];
const browser = await chromium.launch({ executablePath, args: flags });
const left = [];

async function opened(hash = '', options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, bypassCSP: true, ...options });
  const page = await context.newPage();
  page.on('request', (request) => {
    if (!/^(file|blob|data):/.test(request.url())) left.push(request.url());
  });
  page.on('pageerror', (error) => {
    throw error;
  });
  await page.goto(url + hash);
  await page.waitForSelector('#shape path.own', { state: 'attached' });
  return page;
}

/** Both trees are the same, numbers to a share of them. */
function same(a, b, share, place = '') {
  if (typeof a === 'number' && typeof b === 'number')
    return assert.ok(Math.abs(a - b) <= share * Math.max(1e-9, Math.abs(a), Math.abs(b)), `${place}: ${a} and ${b}`);
  if (a === null || typeof a !== 'object') return assert.deepEqual(a, b, place);
  assert.deepEqual(Object.keys(a), Object.keys(b), place);
  for (const key of Object.keys(a)) same(a[key], b[key], share, `${place}.${key}`);
}

const ask = (page, question) =>
  page.evaluate(
    (question) => window.ibr.ask(question).ok ?? Promise.reject(new Error(JSON.stringify(window.ibr.ask(question)))),
    question,
  );
const PARTS = 'tip markers ledger curvature_per_m jacobian segments sections beyond p_act_channels_kpa p_body_kpa';
const states = (own) => Object.fromEntries(PARTS.split(' ').map((key) => [key, own[key]]));

/** Two states to 1e-12. In space slopes are quotients of differences, which magnify the last bit. */
function alike(a, b, place) {
  const [{ jacobian: slopes, ...own }, { jacobian, ...wanted }] = [states(a), states(b)];
  same(own, wanted, 1e-12, place);
  same(slopes, jacobian, b.sections ? 1e-8 : 1e-12, place);
}

/** The first view is the story of `ibr demo`, at both widths without a bar to scroll the page sideways. */
async function story_comes_first() {
  for (const width of [390, 1280]) {
    const page = await opened('', { viewport: { width, height: 900 } });
    await page.waitForFunction(() => window.ibr.panels === 5, null, { timeout: 120_000 });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width} px`);
    await page.screenshot({ path: join(folder, `panels-${width}.png`), fullPage: true });
  }
}

async function numbers_are_the_programs() {
  const page = await opened(),
    start = await ask(page, { ask: 'start' });
  assert.equal(start.robots.length, 10);
  let count = 0;
  for (const robot of start.robots.map((r) => r.name))
    for (const pressures of [
      [10, 20, 30],
      [0, 5, 60],
    ]) {
      const own = native('predict', robot, '--pressure', pressures.map((p) => `${p}kPa`).join(',')).states;
      for (const [i, p] of pressures.entries()) {
        const told = await ask(page, { ask: 'predict', robot: { name: robot }, actuator_kpa: [p] });
        alike(told, own[i], `${robot} at ${p} kPa`);
        count += 1;
      }
    }
  // Channels at pressures of their own.
  const two = native('predict', 'epam-two-strips', '--pressure', '20kPa/10kPa').states[0];
  const both = await ask(page, { ask: 'predict', robot: { name: 'epam-two-strips' }, actuator_kpa: [20, 10] });
  alike(both, two, 'two channels');
  assert.ok(two.tip.y_mm > two.tip.z_mm && two.tip.z_mm > 1);
  // Sizes and effects as a hand sets them, as the file that the page saves.
  const changes = [
    ['body.radius_mm', '35'],
    ['actuator.count', '5'],
    ['effects.friction.moment_nm', '0.01'],
    ['effects.gravity.weight_n_per_m', '1.5'],
  ];
  const robot = { name: 'cpam', changes },
    saved = join(scratch, 'mine.toml');
  writeFileSync(saved, (await ask(page, { ask: 'robot', robot })).text);
  const { jacobian: slopes, ...hand } = states(await ask(page, { ask: 'predict', robot, actuator_kpa: [17] }));
  const { jacobian, ...kept } = states(native('predict', saved, '--pressure', '17kPa').states[0]);
  same(hand, kept, 1e-12, 'changed');
  // Slopes of a loaded robot are quotients of differences too.
  same(slopes, jacobian, 1e-9, 'slopes');
  // A comparison and a diagnosis are those of the program; fits end where their steps end, so to fewer digits.
  const data = { name: 'synthetic-epam' },
    mine = { name: 'epam-textbook' };
  const without = ({ pictures, measured_m, error_mm, ...rest }) => rest;
  same(
    without(await ask(page, { ask: 'compare', robot: mine, data })),
    native('compare', 'epam-textbook', 'synthetic-epam'),
    1e-9,
    'compare',
  );
  const { pictures, candidates, verdict_words, ...found } = await ask(page, { ask: 'diagnose', robot: mine, data });
  const own = native('diagnose', 'epam-textbook', 'synthetic-epam');
  assert.deepEqual(
    [found.verdict, found.indistinguishable, found.ranked.map((r) => r.effect)],
    [own.verdict, own.indistinguishable, own.ranked.map((r) => r.effect)],
  );
  same(found.base, own.base, 1e-6, 'base');
  assert.ok(pictures.missing_moment.includes('<svg'));
  // A candidate leaves what its diagnosis says that it leaves.
  for (const { name, changes, after_mm } of candidates.slice(0, 3)) {
    const { error_mm } = await ask(page, { ask: 'compare', robot: { ...mine, changes }, data });
    assert.ok(Math.abs(error_mm - after_mm) < 0.01 + 0.01 * after_mm, `${name}: ${error_mm} and ${after_mm} mm`);
  }
  // A table that is dropped is read as the embedded set is.
  const set = start.data.find((d) => d.name === data.name);
  const dropped = await ask(page, {
    ask: 'compare',
    robot: mine,
    data: { name: 'synthetic-epam.csv', csv: set.csv, about: set.about },
  });
  same(dropped.overall, native('compare', 'epam-textbook', 'synthetic-epam').overall, 1e-9, 'dropped');
  const refused = await page.evaluate(
    () =>
      window.ibr.ask({
        ask: 'predict',
        robot: { name: 'epam', changes: [['body.radius_mm', '0.04']] },
        actuator_kpa: [10],
      }).error,
  );
  assert.match(refused.message, /^epam:\d+: radius must be from/);
  assert.match(refused.help, /metres/);
  await page.close();
  console.log(`numbers: ${count + 2} states equal the program's to 1e-12, and a comparison and a diagnosis`);
}

async function it_is_quick() {
  const first = [],
    found = [];
  for (let i = 0; i < 3; i++) {
    const page = await opened('#robot=epam-textbook&data=synthetic-epam', { bypassCSP: false });
    first.push(await page.evaluate(() => performance.getEntriesByName('first-shape')[0].startTime));
    await page.waitForSelector('#compared:not([hidden])');
    await page.click('#diagnose');
    await page.waitForSelector('#diagnosed:not([hidden])');
    found.push(await page.evaluate(() => window.ibr.diagnosis_s));
    if (i === 2) await frames(page);
    await page.close();
  }
  const began = performance.now();
  native('diagnose', 'epam-textbook', 'synthetic-epam');
  const own = (performance.now() - began) / 1e3,
    best = (values) => Math.min(...values);
  console.log(
    `quick: first shape after ${best(first).toFixed(0)} ms; diagnosis and its pictures ${best(found).toFixed(2)} s, ${(best(found) / own).toFixed(1)} times the program's ${own.toFixed(2)} s without them`,
  );
  assert.ok(best(first) <= 1000 && best(found) <= 2);
}

/** What a turn of a slider takes, without waiting for the screen. */
async function frames(page) {
  const ms = await page.evaluate(async () => {
    const slider = document.querySelector('#pressures input'),
      times = [];
    for (let i = 0; i < 60; i++) {
      slider.value = 10 + 0.3 * i;
      slider.dispatchEvent(new Event('input'));
      const began = performance.now();
      await new Promise(requestAnimationFrame);
      times.push(performance.now() - began);
    }
    return times.sort((a, b) => a - b)[30];
  });
  console.log(`quick: ${(1000 / ms).toFixed(0)} frames a second while a slider moves`);
  assert.ok(ms < 25, `${ms} ms`);
}

const error = (page) => page.evaluate(() => +document.querySelector('#error').lastChild.textContent.split(' ')[0]);
const settled = (page, wanted) =>
  page.waitForFunction((wanted) => {
    const now = +document.querySelector('#error')?.lastChild?.textContent.split(' ')[0];
    return wanted[0] <= now && now <= wanted[1];
  }, wanted);

async function the_story_can_be_clicked() {
  let page = await opened();
  await page.click('#story');
  await page.waitForSelector('#compared:not([hidden])');
  const before = await error(page),
    map = await page.innerHTML('#residual_map');
  assert.ok(before > 20 && map.includes('<svg'), 'the bare model bends too far');
  await page.click('#diagnose');
  await page.waitForSelector('#diagnosed:not([hidden])');
  assert.match(await page.textContent('#verdict'), /an effect is missing: end constraint or self contact/);
  assert.equal(await page.locator('#missing_moment svg').count(), 1);
  await page.check('#candidates input >> nth=0');
  await settled(page, [0, 1]);
  assert.notEqual(await page.innerHTML('#residual_map'), map, 'the residual map is drawn anew');
  const tip = await page.evaluate(() => window.ibr.state.tip),
    link = await page.evaluate(() => location.hash);
  await page.close();
  page = await opened(link);
  await page.waitForSelector('#diagnosed:not([hidden])');
  await settled(page, [0, 1]);
  same(await page.evaluate(() => window.ibr.state.tip), tip, 0, 'restored');
  assert.ok(await page.isChecked('#candidates input >> nth=0'));
  await page.uncheck('#candidates input >> nth=0');
  await settled(page, [before - 0.01, before + 0.01]);
  await page.close();
  console.log(`story: ${before.toFixed(2)} mm, then below 1 mm with the first candidate; its link brings it back`);
}

async function a_hand_can_turn_everything() {
  const page = await opened('#robot=epam');
  await page.click('#effects-box > summary');
  await page.click('#bare');
  await page.waitForFunction(() => {
    const { tip, bare } = window.ibr.state;
    return tip.y_mm === bare.tip.y_mm;
  });
  await page.click('#given');
  await page.waitForFunction(() => {
    const { tip, bare } = window.ibr.state;
    return tip.y_mm < bare.tip.y_mm - 1;
  });
  const boxes = await page.locator('#effects .effect > label input').all();
  for (const box of boxes) {
    await box.click();
    await box.click();
    assert.ok(await page.isHidden('#fault'), await page.textContent('#fault'));
  }
  const before = await page.evaluate(() => window.ibr.state.p_act_kpa);
  await page.focus('#pressures input');
  await page.keyboard.press('ArrowRight');
  await page.waitForFunction((before) => window.ibr.state.p_act_kpa > before, before);
  const outline = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
  assert.equal(outline, 'solid', 'what has the focus is seen');
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll('input,select,button')]
      .filter((e) => !(e.labels?.length || e.textContent.trim()))
      .map((e) => e.outerHTML),
  );
  assert.deepEqual(nameless, []);
  for (const place of await page.locator('#sizes input').all()) {
    await place.focus();
    await page.keyboard.press('Home');
    await page.keyboard.press('End');
  }
  await page.setInputFiles('#files', [
    {
      name: 'mine.toml',
      mimeType: 'text/plain',
      buffer: Buffer.from('[body]\nradius_mm = 30\nlength_mm = 500\npressure_kpa = 3\n'),
    },
  ]);
  await page.waitForFunction(() => window.ibr.state.length_m === 0.5);
  await page.setInputFiles('#files', [
    { name: 'm.csv', mimeType: 'text/csv', buffer: Buffer.from('run,actuator\n1,epam\n') },
  ]);
  await page.waitForFunction(() => document.querySelector('#fault').textContent.includes('m.csv'));
  await page.close();
  console.log(`by hand: ${boxes.length} effects on and off, sizes, keyboard, own files`);
}

/** A robot with strips round the body: two sides, a slider for every channel, and nothing that is built for one plane. */
async function two_sides_are_seen() {
  const page = await opened('#robot=epam-two-strips&kpa=20,10');
  const is_shown = (id) => page.locator(id).isVisible();
  const count = (what) => page.locator(what).count();
  assert.deepEqual([await count('#shape path.own'), await count('#shape path.unit')], [2, 24]);
  assert.equal(await count('#pressures .dial'), 3, 'two channels and the body');
  assert.deepEqual(
    [await is_shown('#measurements'), await is_shown('#finite'), await is_shown('#far-key')],
    [false, false, true],
  );
  const before = await page.evaluate(() => window.ibr.state.tip),
    letters = await page.locator('#shape text').allTextContents(),
    told = await page.textContent('#tip');
  assert.deepEqual(letters, ['x', 'y', 'x', 'z', '100 mm']);
  assert.ok(told.includes(`y ${before.y_mm.toFixed(1)} mm, z ${before.z_mm.toFixed(1)} mm`), told);
  // The second channel alone moves what is drawn towards z.
  await page.locator('#pressures input').nth(1).fill('30');
  await page.waitForFunction((z) => window.ibr.state.tip.z_mm > z + 10, before.z_mm);
  assert.deepEqual((await page.evaluate(() => window.ibr.state.p_act_channels_kpa)).slice(0, 2), [20, 30]);
  await page.locator('#pressures input').nth(1).fill('10');
  await page.waitForFunction((z) => window.ibr.state.tip.z_mm === z, before.z_mm);
  // A table that is dropped all the same is refused in words.
  await page.setInputFiles('#files', [
    { name: 'm.csv', mimeType: 'text/csv', buffer: Buffer.from('run,actuator\n1,epam\n') },
  ]);
  await page.waitForFunction(() => document.querySelector('#fault').textContent.includes('built for planar robots'));
  await page.selectOption('#robot', 'epam-helix');
  await page.waitForFunction(() => window.ibr.state.views?.[0].units.length === 6);
  assert.ok((await page.isHidden('#fault')) && (await count('#pressures .dial')) === 2);
  await frames(page);
  await page.selectOption('#robot', 'epam');
  await page.waitForFunction(() => !window.ibr.state.views);
  assert.deepEqual([await is_shown('#measurements'), await is_shown('#far-key')], [true, false]);
  await page.close();
  for (const [width, name, colorScheme] of [
    [390, 'epam-two-strips', 'dark'],
    [1280, 'epam-two-strips', 'light'],
    [390, 'epam-helix', 'light'],
    [1280, 'epam-helix', 'dark'],
  ]) {
    const page = await opened(`#robot=${name}&kpa=20,10`, { viewport: { width, height: 870 }, colorScheme });
    await page.screenshot({ path: join(folder, `${name}-${width}-${colorScheme}.png`) });
    const beyond = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(beyond <= 0, `${width}: the page is ${beyond} px too wide`);
    await page.close();
  }
  console.log(`two sides: ${letters.join(', ')}; ${told}`);
}

async function pictures() {
  for (const [width, height] of [
    [390, 844],
    [1280, 900],
  ])
    for (const colorScheme of ['light', 'dark']) {
      const page = await opened('#robot=epam-textbook&data=synthetic-epam&kpa=30&ask=diagnose', {
        viewport: { width, height },
        colorScheme,
      });
      await page.waitForSelector('#diagnosed:not([hidden])');
      await page.waitForTimeout(500);
      const name = (part) => join(folder, `${part}-${width}-${colorScheme}.png`);
      await page.screenshot({ path: name('first') });
      const beyond = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(beyond <= 0, `${width}: the page is ${beyond} px too wide`);
      await page.check('#candidates input >> nth=0');
      await settled(page, [0, 1]);
      await page.addStyleTag({ content: '.view{position:static!important}' });
      await page.screenshot({ path: name('whole'), fullPage: true });
      await page.close();
    }
  console.log(`pictures: ${folder}`);
}

async function the_studio_runs_finite_elements() {
  const studio = spawn(ibr, ['studio', '--page', file]);
  try {
    const address = await new Promise((done, fail) => {
      studio.stdout.on('data', (text) => {
        const found = /http:\S+/.exec(text);
        if (found) done(found[0]);
      });
      studio.on('exit', () => fail(new Error('it ended')));
    });
    const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
    await page.goto(`${address}#robot=epam&kpa=20`);
    await page.click('#run');
    await page.waitForSelector('#shape path.finite', { timeout: 120000, state: 'attached' });
    const said = await page.textContent('#run-said');
    assert.match(said, /elements at 20 kPa/);
    await page.evaluate(() => scrollTo(0, 0));
    await page.screenshot({ path: join(folder, 'studio.png') });
    await page.close();
    console.log(`studio: ${said.trim()}`);
  } finally {
    studio.kill();
  }
}

try {
  const size = gzipSync(readFileSync(file), { level: 9 }).length;
  assert.ok(size <= 1100e3, `${size} bytes gzipped`);
  await numbers_are_the_programs();
  await story_comes_first();
  await it_is_quick();
  await the_story_can_be_clicked();
  await a_hand_can_turn_everything();
  await two_sides_are_seen();
  await pictures();
  await the_studio_runs_finite_elements();
  assert.deepEqual(left, [], 'requests that left the page');
  console.log(`web: ok, ${Math.ceil(size / 1000)} kB gzipped, no request left the page`);
} finally {
  await browser.close();
  if (existsSync(scratch)) rmSync(scratch, { recursive: true });
}
