// SPDX-License-Identifier: Apache-2.0
// Verdicts and marks of a study's page, without a page: node study_test.js SOURCE
'use strict';
const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const folder = path.resolve(process.argv[2], 'tools/report');
const Numbers = require(path.join(folder, 'numbers.js'));

// Elements as lists of their children: only the texts count. Tables are their rows, plots what they are given.
const plots = [];
const Dust = {...Numbers, dash: '-', sections: {}, later: [], el: (tag, attributes, ...children) => ({tag, attributes, children, append(...more) { this.children.push(...more); }})};
Dust.p = (attributes, ...children) => Dust.el('p', attributes, ...children.flat());
Dust.strong = (words, look) => Dust.el('strong', {class: look}, words);
Dust.section = (id, title, ...parts) => Dust.el('section', {id}, title, ...parts.flat());
Dust.table = (heads, rows) => Dust.el('table', {}, ...rows.map((row) => Dust.el('tr', {}, ...row)));
Dust.error_bar = (share, error, look) => Dust.el('i', {class: look}, look);
Dust.why_no_error = (figure) => (figure.no_error ? ` (${figure.no_error})` : '');
Dust.duration = String;
Dust.readable_plot = (parent, plot) => plots.push(plot);
const text = (node) => (node === null || node === undefined || node === false ? '' : typeof node === 'object' ? node.children.map(text).join('') : `${node}|`.replace(/\s/gu, ' '));
new Function('Dust', fs.readFileSync(path.join(folder, 'study.js'), 'utf8'))(Dust);

// Verdicts stand as the engine gives them; those that decide nothing are counted for themselves.
const expectation = (verdict, found) => ({output: 'x', then: 'rises', input: 'belt.speed', from: '', to: '', at: '', verdict, text: found, why: 'so'});
const found = text(Dust.sections.expectations({expectations: [
  expectation('as_expected', 'as expected: 30.00 ± 0.14 mm'),
  expectation('open', 'open: 2 of 12 points not steady: 30 mm'),
  expectation('open', 'not told from noise: 30.0 ± 4.0 mm, of so few values 12.71 times the error tells')]}));
assert.ok(found.includes('1 of 3 are as expected, 0 against, 2 undecided.'), found);
assert.ok(found.includes('open: 2 of 12 points not steady: 30 mm|'), found);
assert.ok(/Student.s t/.test(found) && /not steady/.test(found), found);

// Effects: what is told from noise is bold, what is not steady is marked and said.
const cell = (more) => ({change: 30, error: 1, is_clear: true, coverage: '', unsteady: '', ...more});
const effects = (cells) => ({effects: {table: {columns: cells.map(() => ({name: 'speed', unit: 'm/s', from: 1, to: 4})), rows: [{output: 'x', unit: 'mm', cells}]}, outputs: [
  {name: 'x', quantity: 'sensors.s.x', minus: '', rows: [{title: 'x', unit: 'mm', input: 'case', coverage: '', unsteady: '1 of 4 points not steady', rows: [
    {name: 'a', value: 10, error: 1, no_error: ''}, {name: 'b', value: 20, error: null, no_error: '1 of 2 points not steady'}]}],
  plots: [{title: 'x', change: 30, change_error: null, unit: 'mm', coverage: '', unsteady: '2 of 4 points not steady', is_scattered: false,
    lines: [{name: 'mean', x: [1, 4], y: [10, 40], low: [9, null], high: [11, null], no_error: ['', '2 of 2 points not steady']}]}]}]}});
const drawn = text(Dust.sections.effects(effects([cell({}), cell({error: null, is_clear: false, unsteady: '2 of 4 points not steady'})])));
assert.ok(drawn.includes('30.0 ± 1.0 mm|30 mm †|'), drawn);
assert.ok(drawn.includes('bold: told from noise. †: of points that are not steady.'), drawn);
assert.ok(drawn.includes('10.0 ± 1.0||b|20 (1 of 2 points not steady)|hollow|'), drawn);
assert.ok(drawn.includes('Mean against case (1 of 4 points not steady).'), drawn);
assert.ok(!/more than twice/.test(drawn + found), 'the rule is no longer twice the error alone');
assert.ok(!text(Dust.sections.effects(effects([cell({})]))).includes('†'));
Dust.later.forEach((draw) => draw());
assert.strictEqual(plots[0].note, 'Change over the levels: 30\u202fmm (2 of 4 points not steady).');

// All points: why a value has no error stands beside it.
const points = text(Dust.sections.points({points: {inputs: [{name: 'speed', unit: 'm/s'}], outputs: [{name: 'x', unit: 'mm'}], rows: [
  {hash: 'a', seed: 1, status: 'finished', reason: '', wall_s: 1, inputs: ['1'], outputs: [{value: 10, error: null, no_error: 'not steady'}]}]}}));
assert.ok(points.includes('10 (not steady)|'), points);
