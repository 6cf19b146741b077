// SPDX-License-Identifier: Apache-2.0
// Numbers of the pages as on paper: node numbers_test.js SOURCE
'use strict';
const assert = require('node:assert');
const path = require('node:path');
const N = require(path.resolve(process.argv[2], 'tools/report/numbers.js'));

assert.strictEqual(N.value(0.128404, 0.00031), '0.12840\u00a0±\u00a00.00031');
assert.strictEqual(N.value(128.404, 31), '128\u00a0±\u00a031');
assert.strictEqual(N.value(422535, 72252), '423\u202f000\u00a0±\u00a072\u202f000');
assert.strictEqual(N.value(36, 4.3e-10), '36\u00a0±\u00a04.3\u202f×\u202f10⁻¹⁰');
assert.strictEqual(N.value(-2.5, -1), '−2.5');
assert.strictEqual(N.value(3.1e7, 4.2e6), '(3.10\u00a0±\u00a00.42)\u202f×\u202f10⁷');
assert.strictEqual(N.quantity(3.1e-7, 4.2e-8, 'kg/m3'), '310\u00a0±\u00a042\u202fµg/m³');
assert.strictEqual(N.quantity(0.35, null, 'm'), '350\u202fmm');
assert.strictEqual(N.quantity(0, -1, 'g/t'), '0');
assert.strictEqual(N.quantity(null, null, 'm'), '–');
assert.strictEqual(N.quantity(41, 0.3, 'deg'), '41.00\u00a0±\u00a00.30\u202fdeg');
assert.strictEqual(N.quantity(12, -1, '1'), '12');
assert.strictEqual(N.quantity(2.5, -1, 'kg/s'), '2.5\u202fkg/s');
assert.strictEqual(N.quantity(1.25, -1, 'm3/s'), '4500\u202fm³/h');
assert.strictEqual(N.quantity(1e-12, -1, 'm3/s'), '3.6\u202fmm³/h');
assert.strictEqual(N.quantity(0.8202, -1, 'rad'), '46.99°');
assert.strictEqual(N.quantity(24634, -1, 'Pa'), '24.63\u202fkPa');
assert.strictEqual(N.quantity(0.02, -1, 'Pa'), '0.02\u202fPa');
assert.strictEqual(N.quantity(0.02, -1, 'm/s'), '0.02\u202fm/s');
assert.strictEqual(N.quantity(1.5e-9, -1, 'm/s'), '5.4\u202fµm/h');
assert.strictEqual(N.quantity(10.5, 4.4, 'kg/h'), '10.5\u00a0±\u00a04.4\u202fkg/h');
assert.strictEqual(N.quantity(1800, -1, 'kg'), '1.8\u202ft');
// In a domain of a plant's size flows from 1 t/h on are t/h, and places m.
N.set_extent(3.4);
assert.strictEqual(N.quantity(138.9, 1.4, 'kg/s'), '500.0\u00a0±\u00a05.0\u202ft/h');
assert.strictEqual(N.quantity(0.006, -1, 'kg/s'), '6\u202fg/s');
N.set_extent(0.34);
assert.strictEqual(N.quantity(138.9, -1, 'kg/s'), '138.9\u202fkg/s');
assert.deepStrictEqual([3.4, 0.34, 5e-4].map((extent) => N.place_unit(extent).unit), ['m', 'mm', 'µm']);
assert.strictEqual(N.number(1104.2, 3), '1\u202f104');
assert.strictEqual(N.number(-1.5e-6), '−1.5\u202f×\u202f10⁻⁶');
assert.strictEqual(N.number(99.97, 2), '100');
assert.strictEqual(N.number(NaN), '–');
assert.strictEqual(N.count(1234567), '1\u202f234\u202f567');
assert.strictEqual(N.duration(3725), '1\u202fh 02\u202fmin');
assert.strictEqual(N.duration(59.94), '59.9\u202fs');
assert.strictEqual(N.percent(0.6881), '69\u202f%');
assert.strictEqual(N.percent(1e-6), '<\u202f0.01\u202f%');
assert.strictEqual(N.words('class_10_um/sum_of_lumps'), 'class 10 µm / sum of lumps');
assert.strictEqual(N.plural(1, 'limit'), '1 limit');
