// SPDX-License-Identifier: Apache-2.0
// The fold-outs of "Limits and health": what the summary holds, in rows that are read: node health_test.js SOURCE
'use strict';
const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const folder = path.resolve(process.argv[2], 'tools/report');
const Numbers = require(path.join(folder, 'numbers.js'));

// Elements as lists of their children: only the texts count. Rows of tables as lists of their cells.
const Dust = {...Numbers, data: {}, el: (tag, attributes, ...children) => ({tag, attributes, children})};
global.Node = class {};
for (const name of ['parts.js', 'plant.js', 'health.js']) new Function('Dust', fs.readFileSync(path.join(folder, name), 'utf8'))(Dust);
const text = (node) => (node === null || node === undefined || node === false ? '' : typeof node === 'object' ? node.children.map(text).join('') : String(node));
const all = (node, tag) => (node && node.children ? [...(node.tag === tag ? [node] : []), ...node.children.flatMap((child) => all(child, tag))] : []);
const rows = (node) => all(node, 'tr').map((row) => row.children.map(text));
// {title of a fold-out: its rows}
const folds = (summary) => Object.fromEntries(all(Dust.sections.health({summary, limits: [], notes: [], crushed: null}), 'details')
  .map((fold) => [text(fold.children[0]), rows(fold)]));

// Grains are numbered, one in a row; a place is one entry, not three of one name.
const grain = (id, x) => ({id, diameter_m: 0.03, place_m: [x, 2.2, 0.427], step: 23472, time_s: 2.445});
const counters = folds({health: {grains_left: {back: {count: 522, mass_kg: 18.2, first: [grain(135, 0.86), grain(27, 0.72)]}}, is_even: true, entries_waiting: 0}})['Counters of the run'];
assert.deepStrictEqual(counters, [
  ['grains left / back / count', '522'], ['grains left / back / mass kg', '18.2'],
  ['grains left / back / first / 1', 'id 135, diameter 30\u202fmm, place 0.86, 2.2, 0.427\u202fm, step 23\u202f472, time 2.445\u202fs'],
  ['grains left / back / first / 2', 'id 27, diameter 30\u202fmm, place 0.72, 2.2, 0.427\u202fm, step 23\u202f472, time 2.445\u202fs'],
  ['is even', 'yes'], ['entries waiting', '0'],
]);

// Rates and indices are tables of values with their errors, one line each way and kind, and no other entries.
const figure = (value, unit, more = {}) => ({value, unit, uncertainty: null, role: 'detail', quantity: 'mass_rate', ...more});
const told = folds({
  dust_rates: {observed: figure(1, 's'), 'left/all/rate': figure(0.1, 'kg/h', {no_error: 'not steady'}), 'left/all/per_load': figure(0.347, 'g/t', {uncertainty: 0.01}),
    'left/all/class/10_um/rate': figure(0.02, 'kg/h', {uncertainty: 0.001}), 'left/back/rate': figure(0, 'kg/h'), 'left/right/rate': figure(9.9e-18, 'kg/h', {no_error: 'not steady'})},
  stream_indices: {observed: figure(1, 's'), 'entrained_air/flow': figure(0.5, 'm3/s', {no_error: 'not steady'}), 'entrained_air/height': figure(1.79, 'm')},
  forces: {active: ['gravity', 'contact hertz_mindlin (coal, steel)'], sum: {value: 2, unit: 'N', uncertainty: 0.1}}, hoods: {hood: {at: [1, 2, 3], nothing: null, none: []}},
});
assert.deepStrictEqual(told['Rates of dust'], [['', 'Rate', 'Per tonne of load'],
  ['left / all', '100\u202fg/h (not steady)', '347\u00a0±\u00a010\u202fmg/t'], ['left / all / class / 10 µm', '20.0\u00a0±\u00a01.0\u202fg/h', ''], ['left / back', 'none', ''], ['left / right', 'none', '']]);
assert.deepStrictEqual(told['Indices of the stream'], [['entrained air / flow', '1800\u202fm³/h (not steady)'], ['entrained air / height', '1.79\u202fm']]);
assert.deepStrictEqual(told['Other entries of the summary'], [['forces / active', 'gravity; contact hertz_mindlin (coal, steel)'], ['forces / sum', '2.00\u00a0±\u00a00.10\u202fN'], ['hoods / hood / at', '1, 2, 3']]);
// Nothing of it, no fold-out.
assert.strictEqual(Dust.sections.health({summary: {dust_rates: {}}, limits: [], notes: [], crushed: null}), null);
