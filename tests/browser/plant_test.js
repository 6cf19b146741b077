// SPDX-License-Identifier: Apache-2.0
// The first screen of a plant and the tables of the picture in three dimensions, without a page: node plant_test.js SOURCE
'use strict';
const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const folder = path.resolve(process.argv[2], 'tools/report');
const Numbers = require(path.join(folder, 'numbers.js'));

// Elements as lists of their children: only the texts count.
const Dust = {...Numbers, data: {}, el: (tag, attributes, ...children) => ({tag, attributes, children})};
const load = (name) => new Function('Dust', fs.readFileSync(path.join(folder, name), 'utf8'))(Dust);
load('parts.js');
Dust.p = (attributes, ...children) => Dust.el('p', attributes, ...children.flat());
Dust.bar = () => '';
const text = (node) => (node === null || node === undefined || node === false ? '' : typeof node === 'string' ? node + '|' : node.children.map(text).join(''));
for (const name of ['plant.js', 'space_axes.js']) load(name);

// Details that sensors mark stand in the order of the scenario and of their rank, whatever their names.
Numbers.set_extent(3);
const marked = (value, unit, index, more = {}) => ({value, unit, uncertainty: null, towards: 'overview', index, ...more});
const cards = Dust.overview_answers({
  summary: {sensors: {
    a: {zeta: marked(0.5, '1', 2), alpha: marked(100, 'kg/s', 1), other: {value: 7, unit: '1', uncertainty: null}},
    b: {mean: marked(2, 's', 1, {quantity: 'time'})},
    c: {other: {value: 7, unit: '1', uncertainty: null}},
    d: {rate: marked(0, 'kg/h', 1)},
  }},
  setting: {sensors: [{name: 'b', what: 'How long.'}, {name: 'a'}, {name: 'd'}]},
});
assert.deepStrictEqual(cards.map(text), ['B|2\u202fs|mean time|', 'A|360\u202ft/h|alpha|zeta|0.5|',
  'Nothing counted|1 sensor|d: nothing came by, or their start-up had not passed.|']);
// Why a figure has no error stands beside it. Less than a nanogram per m3, hour or tonne is none: what spreads through the cells of a
// field by rounding is not told as dust.
const face = (...values) => text(Dust.overview_answers({summary: {sensors: {face: Object.fromEntries(values.map(([value, more], k) => [`point_${k + 1}/inhalable`, marked(value, 'mg/m3', k + 1, more)]))}}})[0]);
assert.strictEqual(face([5e-36, {uncertainty: 5.8e-36}], [1.863e-15, {no_error: 'not steady'}]), 'Face|none|point 1 / inhalable|point 2 / inhalable|none|No dust there yet: less than a nanogram per m³ is none.|');
assert.strictEqual(face([0], [2e-9]), 'Face|none|point 1 / inhalable|point 2 / inhalable|none|No dust there yet: less than a nanogram per m³ is none.|');
assert.strictEqual(face([1.25, {no_error: 'not steady'}], [1e-15], [2, {uncertainty: 0.1}]), 'Face|1.25\u202fmg/m³ (not steady)|point 1 / inhalable|point 2 / inhalable|none|point 3 / inhalable|2.00\u00a0±\u00a00.10\u202fmg/m³|Less than a nanogram per m³ is none.|');
// Nothing known to within milligrams is not none.
assert.strictEqual(face([1e-9, {uncertainty: 0.5}]), 'Face|0.00\u00a0±\u00a00.50\u202fmg/m³|point 1 / inhalable|');
assert.ok(face([0], [0]).startsWith('Nothing counted|'));
assert.ok(text(Dust.overview_answers({summary: {sensors: {a: {rate: marked(1e-13, 'kg/h', 1)}}}})[0]).includes('none|rate|Less than a nanogram per h is none.|'));

// Dust that the load carries: sums over the classes; what settles, leaves and is drawn out are told apart.
const dusty = {
  simulated_s: 3600, mass_kg: {emitted: 1000},
  dust_on_grains: {classes: {
    x: {entered_kg: 1, set_free_kg: 0.003, set_free_by: {grains: {kg: 0.001}, spoon: {kg: 0.002}}, balance_error: 1e-16},
    y: {entered_kg: 2, set_free_kg: 0.001, set_free_by: {grains: {kg: 0.001}}, balance_error: -2e-16},
  }},
  dust_field: {classes: {
    x: {airborne_kg: 0.0005, deposited_kg: {belt: 0.0005}, left_kg: {left: 0.0005}, hoods_kg: {top: 0.0015}, balance_error: 0},
    y: {airborne_kg: 0, deposited_kg: {belt: 0.0005}, left_kg: {left: 0.0005}, hoods_kg: {}, balance_error: 0},
  }},
};
const sums = Dust.load_dust({summary: dusty});
assert.strictEqual(sums.fed, 3);
assert.ok(Math.abs(sums.free - 0.004) < 1e-15);
assert.strictEqual(sums.causes[0].name, 'grains');  // 2 g of two classes; the spoon's 2 g are of one
assert.ok(Math.abs(sums.airborne + sums.settled + sums.out + sums.drawn - sums.free) < 1e-15);
// Sources beside the load count to what comes into the air, not to what comes off the load.
const leaky = {
  simulated_s: 3600, mass_kg: {emitted: 1000},
  dust_on_grains: {classes: {x: {entered_kg: 1, set_free_kg: 0.001, set_free_by: {grains: {kg: 0.001}}, balance_error: 0}}},
  dust_field: {classes: {x: {released_kg: 0.011, airborne_kg: 0, deposited_kg: {}, left_kg: {left: 0.011}, hoods_kg: {}, balance_error: 0}}},
  dust_rates: {observed: {value: 10}, 'set_free/all/rate': {value: 0.001, uncertainty: 1e-4}, 'set_free/all/per_load': {value: 1, uncertainty: 0.1}, 'set_free/grains/rate': {value: 0.001, uncertainty: 1e-4},
    'released/all/rate': {value: 0.01, uncertainty: 0}, 'left/all/rate': {value: 0.011, uncertainty: 1e-4}, 'left/left/rate': {value: 0.011, uncertainty: 1e-4}},
};
const leak = Dust.dust_stream({summary: leaky}), leak_screen = Dust.load_dust_answers({summary: leaky}).map(text).join('');
assert.ok(Math.abs(leak.free.rate.value - 0.011) < 1e-15 && leak.free.rate.uncertainty === 1e-4);
assert.ok(Math.abs(leak.airborne.rate.value) < 1e-15);
assert.ok(leak_screen.includes('How much dust?|1.00\u00a0±\u00a00.10\u202fg/t|'));
assert.ok(leak_screen.includes('given by sources beside it|') && !leak_screen.includes('its cloud shrinks'));
const leak_whole = Dust.dust_stream({summary: {...leaky, dust_rates: {}}});
assert.ok(Math.abs(leak_whole.free.rate.value - 0.011) < 1e-15 && Math.abs(leak_whole.came_off.rate.value - 0.001) < 1e-15);
assert.strictEqual(sums.error, 2e-16);
assert.strictEqual(sums.caught, 0);  // of a run without scavenging
const {classes: {x, y}} = dusty.dust_field;
const raining = {...dusty, dust_field: {classes: {x: {...x, airborne_kg: 0.0002, caught_by_grains_kg: 0.0003}, y}}};
assert.strictEqual(Dust.load_dust({summary: raining}).caught, 0.0003);
assert.ok(Dust.load_dust_answers({summary: raining, release_map: null, extraction: null}).map(text).some((a) => a.includes('caught by grains|7.5\u202f%')));
assert.ok(!Dust.load_dust_answers({summary: dusty, release_map: null, extraction: null}).map(text).some((a) => a.includes('caught by grains')));
const answers = Dust.load_dust_answers({summary: dusty, release_map: null, extraction: null}).map(text);
assert.ok(answers[0].startsWith('How much dust?|4\u202fg/t|4\u202fg/h set free'), answers[0]);
assert.ok(answers[0].includes('1\u202fg/t get out with the air (1\u202fg/h)'), answers[0]);
assert.ok(answers.at(-1).startsWith('Where to extract?|60\u202f% caught|'), answers.at(-1));  // 1.5 of 2.5 g
assert.ok(answers[3].startsWith('How sure?|no error known|Means over the whole 3'), answers[3]);
// With rates of the steady stream these are told, with their errors; the sums of the whole run are not.
const rate = (value, uncertainty, more = {}) => ({value, unit: 'kg/h', uncertainty, ...more});
const steady = {...dusty, dust_rates: {
  observed: {value: 1800, unit: 's'},
  'set_free/all/rate': rate(10, 0.5), 'set_free/all/per_load': rate(20, 1), 'set_free/grains/rate': rate(3, 0.1), 'set_free/spoon/rate': rate(7, 0.4),
  'set_free/spoon/class/x/rate': rate(7, 0.4), 'left/all/rate': rate(2, null, {no_error: 'not steady'}), 'left/all/per_load': rate(4, null),
  'left/left/rate': rate(2, null, {no_error: 'not steady'}), 'drawn_out/all/rate': rate(6, 0.3), 'drawn_out/top/rate': rate(6, 0.3), 'deposited/all/rate': rate(1, 0.1),
}};
// What grains catch in it is not in the air any more.
const caught_rate = {...steady, dust_rates: {...steady.dust_rates, 'caught/all/rate': rate(0.5, 0.1)}};
assert.ok(Math.abs(Dust.dust_stream({summary: caught_rate}).airborne.rate.value - 0.5) < 1e-12);
assert.ok(Math.abs(Dust.dust_stream({summary: steady}).airborne.rate.value - 1) < 1e-12);
// What settles on a belt and rides out of the domain with it goes somewhere too.
const riding_rate = {...steady, dust_rates: {...steady.dust_rates, 'carried_out/all/rate': rate(0.5, 0.1), 'carried_out/belt_2/rate': rate(0.5, 0.1)}};
const riding = {...dusty, dust_field: {classes: {x: {...x, airborne_kg: 0.0002, carried_out_kg: {belt_2: 0.0003}}, y}}};
for (const [summary, said] of [[riding_rate, '5\u202f%'], [riding, '7.5\u202f%']]) {
  const [, , fates] = Dust.load_dust_answers({summary, release_map: null, extraction: null}).map(text);
  assert.ok(fates.includes(`out lying on belt 2|${said}`), fates);
}
const told = Dust.load_dust_answers({summary: steady, release_map: null, extraction: null}).map(text);
assert.ok(told[0].startsWith('How much dust?|20.0\u00a0±\u00a01.0\u202fg/t|10.00\u00a0±\u00a00.50\u202fkg/h set free'), told[0]);
// What has no error says why, also in the middle of a sentence.
assert.ok(told[0].includes('4\u202fg/t get out with the air (2\u202fkg/h; not steady)'), told[0]);
assert.ok(told[4].includes('Most gets out at left (2\u202fkg/h; not steady)'), told[4]);
assert.ok(told[1].startsWith('From where?|Spoon|spoon|70\u202f%||grains on grains|30'), told[1]);
assert.ok(told[2].includes('still in the air|10\u202f%|'), told[2]);
assert.ok(told[3].startsWith('How sure?|± one standard error|Means over the last 1'), told[3]);
assert.ok(told[3].includes('Not steady yet: what goes out at left.'), told[3]);
assert.ok(told[4].startsWith('Where to extract?|75\u202f% caught (not steady)|'), told[4]);
// A batch that was released before: no amount per tonne stands among the rates, and none is 0; the whole run tells it.
const told_of = (summary) => Dust.load_dust_answers({summary, release_map: null, extraction: null}).map(text);
const without_load = (more = {}) => Object.fromEntries(Object.entries({...steady.dust_rates, ...more}).filter(([name]) => !name.endsWith('/per_load')));
const batch = told_of({...dusty, dust_rates: without_load()});
assert.ok(batch[0].startsWith('How much dust?|4\u202fg/t|of all that was released, set free over the whole run|10.00\u00a0±\u00a00.50\u202fkg/h set free'), batch[0]);
assert.ok(batch[0].includes('1\u202fg/t get out with the air (2\u202fkg/h; not steady)'), batch[0]);
assert.ok(batch[3].includes('amounts per tonne are what has come off in the whole run'), batch[3]);
const uneven = told_of({...steady, dust_rates: {...steady.dust_rates, 'set_free/all/per_load': {value: null, unit: 'g/t', uncertainty: null, no_error: 'feed not even'}}});
assert.ok(uneven[0].startsWith('How much dust?|4\u202fg/t|'), uneven[0]);
assert.ok(!told[0].includes('whole run') && !told[3].includes('whole run'), told[3]);
// More leaves the air than comes: the cloud shrinks, and nothing has settled. Two digits of a mean that is not steady.
const shrinking = told_of({...steady, dust_rates: {...steady.dust_rates, 'deposited/all/rate': rate(8, 0.1), 'set_free/all/rate': rate(10.1234, null, {no_error: 'not steady'})}});
assert.ok(shrinking[3].startsWith('How sure?|not steady yet|') && shrinking[3].includes('by 58\u202f% of what comes: its cloud shrinks.'), shrinking[3]);
assert.ok(!shrinking[3].includes('settled'), shrinking[3]);
assert.ok(shrinking[0].includes('10\u202fkg/h (not steady) set free'), shrinking[0]);
const restless = {no_error: 'not steady'}, loads = {'set_free/all/per_load': rate(20, null, restless), 'left/all/per_load': rate(0.347, null, restless)};
const unsteady = told_of({...steady, dust_rates: {...steady.dust_rates, ...loads}});
assert.ok(unsteady[0].startsWith('How much dust?|20\u202fg/t (not steady)|') && unsteady[0].includes('350\u202fmg/t (not steady) get out with the air (2\u202fkg/h; not steady)'), unsteady[0]);
// At rest: shares of next to nothing are those of the whole run.
const resting = told_of({...dusty, dust_rates: {observed: {value: 1800, unit: 's'}, 'set_free/all/rate': rate(1e-12, null), 'set_free/spoon/rate': rate(1e-12, null), 'deposited/all/rate': rate(1, null)}});
assert.ok(resting[2].includes('settled|25\u202f%|'), resting[2]);
assert.ok(resting[3].includes('Hardly any dust comes in the last 1'), resting[3]);
// Of a branch with something set otherwise that is of two plants, and amounts per tonne are not told.
const mixed = {...dusty, start_from: {rates_since_s: 900}, dust_rates: {observed: {value: 1800, unit: 's'}, 'set_free/all/rate': rate(1e-12, null), 'deposited/all/rate': rate(1, null)}};
assert.ok(told_of(mixed)[3].includes('means over two plants') && !resting[3].includes('two plants'), told_of(mixed)[3]);
assert.ok(!Number.isFinite(Dust.dust_stream({summary: mixed}).free.load.value));
assert.ok(Number.isFinite(Dust.dust_stream({summary: {...mixed, start_from: {rates_since_s: 0}}}).free.load.value));
// A field without loads: what its sources give, where it goes and what a hood catches.
const field_of = (released, more) => ({simulated_s: 4, mass_kg: {emitted: 0}, dust_field: {classes: {x: {released_kg: released, airborne_kg: 0, deposited_kg: {}, left_kg: {}, hoods_kg: {}, balance_error: 0, ...more}}}});
const sourced = told_of({...field_of(1e-5, {airborne_kg: 2e-6, hoods_kg: {top: 6e-6}, left_kg: {left: 2e-6}}), dust_rates: {observed: {value: 2, unit: 's'}, 'released/all/rate': rate(0.01, 1e-4),
  'left/all/rate': rate(0.0025, 1e-4), 'left/left/rate': rate(0.0025, 1e-4), 'drawn_out/all/rate': rate(0.0075, 1e-4), 'drawn_out/top/rate': rate(0.0075, 1e-4)}});
assert.ok(sourced[0].startsWith('How much dust?|10.00\u00a0±\u00a00.10\u202fg/h|given by its sources; 10\u202fmg in the whole run'), sourced[0]);
assert.ok(sourced[0].includes('get out with the air'), sourced[0]);
assert.ok(sourced[1].startsWith('Where does it go?|Drawn out at top|drawn out at top|75\u202f%|'), sourced[1]);
assert.ok(sourced.at(-1).startsWith('Where to extract?|75\u202f% caught|'), sourced.at(-1));
assert.ok(!sourced.some((a) => a.includes('NaN') || a.includes('the load') || a.includes('From where')), sourced.join());
const empty = told_of({...field_of(0, {}), dust_rates: {observed: {value: 2, unit: 's'}, 'released/all/rate': rate(0, 0)}});
assert.ok(empty[0].startsWith('How much dust?|none|Nothing gave any dust'), empty[0]);
assert.ok(!empty.join().includes('settled'), empty.join());
// A cloud that was there at the start.
const cloud = told_of({...field_of(1e-5, {airborne_kg: 4e-6, deposited_kg: {bottom: 6e-6}}), dust_rates: {observed: {value: 2, unit: 's'}, 'released/all/rate': rate(0, 0), 'deposited/all/rate': rate(1e-3, 1e-5)}});
assert.ok(cloud[1].startsWith('Where does it go?|Settled|still in the air|40\u202f%||settled|60') || cloud[1].includes('settled|60\u202f%|'), cloud[1]);

// Rules and indices of practice, each where its inputs are known.
const ranked = {...steady, dust_estimates: {ap42_drop: {}, vdi_3790_3: {fall_height_m: 4, over_2_m: 2.3784}, induced_air: {air_m3_per_s: 0.13551, air_m3_per_tonne: 13.551}}, stream_indices: {
  observed: {value: 2, unit: 's'}, 'impact/all/power': {value: 200, unit: 'W', uncertainty: null}, 'impact/all/per_load': {value: 20, unit: 'J/kg', uncertainty: null},
  'impact/spoon/power': {value: 150, unit: 'W', uncertainty: 5}, 'impact/grains/power': {value: 50, unit: 'W', uncertainty: 2},
  'entrained_air/flow': {value: 0.2, unit: 'm3/s', uncertainty: 0.01}, 'entrained_air/per_load': {value: 20, unit: 'm3/t', uncertainty: 1},
  'looseness/void_fraction': {value: 0.98, unit: '1'}, 'looseness/densest_void_fraction': {value: 0.5, unit: '1'},
}};
const practice = Dust.load_dust_answers({summary: ranked, release_map: null, extraction: null}).map(text);
assert.ok(practice[0].includes('VDI 3790-3: 2.4'), practice[0]);
assert.ok(practice[0].includes('Anderson\'s rule: '), practice[0]);
assert.ok(practice[3].startsWith('By the indices of practice?|20\u202fJ/kg|Impacts dissipate it: spoon 150'), practice[3]);
assert.ok(practice[3].includes('Looseness: 98\u202f% of the stream is air where it is loosest, 50\u202f%'), practice[3]);
const drawn_along = text(Dust.indices_answer({summary: {stream_indices: {'entrained_air/flow': {value: 0.4995, unit: 'm3/s', uncertainty: null, no_error: 'not steady'},
  'entrained_air/per_load': {value: 6, unit: 'm3/t', uncertainty: null, no_error: 'not steady'}}}}));
assert.strictEqual(drawn_along, 'By the indices of practice?|1800\u202fm³/h (not steady)|Entrained air: the stream takes 1800\u202fm³/h (not steady) down with it (6\u202fm³/t; not steady)|');
assert.ok(!told.some((a) => a.includes('indices of practice') || a.includes('VDI') || a.includes('Anderson')));
const unfed = {...steady, stream_indices: {observed: {value: 2, unit: 's'}, 'impact/all/power': {value: 200, unit: 'W', uncertainty: null}}};
assert.ok(text(Dust.indices_answer({summary: unfed})).startsWith('By the indices of practice?|200\u202fW|'));

// The hood's flow, and places of low pressure to try.
Dust.place_xyz = ({x, y, z}) => [x, y, z].join(' ');
Dust.depth = (place) => place.depth.value + ' Pa';
const places = [{x: 1, y: 2, z: 3, depth: {value: -4}}];
const where = text(Dust.load_dust_answers({summary: dusty, release_map: null, extraction: {places},
  setting: {sides: [{name: 'left'}, {name: 'top', flow_m3_per_s: 1.25}], bodies: []}}).at(-1));
assert.ok(where.includes('top (4500\u202fm³/h) extracts|'), where);
assert.ok(where.includes('Low pressure|, to be tried:|1 2 3|-4 Pa|'), where);
assert.ok(Dust.has_hoods_for_load_dust({summary: dusty}) && !Dust.has_hoods_for_load_dust({summary: {}}));
assert.strictEqual(Dust.load_dust({summary: {}}), null);
const limit = (is_touched) => ({key: 'smallest_void_fraction', is_touched});
assert.strictEqual(text(Dust.limits_text({limits: [limit(false)]})), 'No limit of validity touched|');
assert.strictEqual(text(Dust.limits_text({limits: [limit(true), limit(false)]})), '1 limit of validity touched|: smallest void fraction|');

// Silence is not taken for none.
const coarse = {grains: {classes: [0.008, 0.06], is_dust: [false, false]}, summary: {}, dust: null};
assert.ok(text(Dust.no_dust_answer(coarse)).includes('not computed|The finest grains here are 8\u202fmm'));
assert.strictEqual(Dust.no_dust_answer({...coarse, grains: {classes: [1e-5, 0.06], is_dust: [true, false]}}), null);
assert.strictEqual(Dust.no_dust_answer({...coarse, summary: dusty}), null);

// Grains as the picture has them: codes of 16 bits between the view's ends, speed by its root.
const space = {min: [0, -1, 0], max: [2, 1, 1], air: {origin: [0, -1, 0], step: [1, 1, 1], count: [2, 2, 1], speed: 4}};
const frame = {n: 1, x: [65535], z: [0], size: [1], speed: [51], depth: [255], depth_low: [255]};
const [heads, columns] = Dust.space_tables.grains({classes: [0.01, 0.02], speed: 5, depth_bytes: 2}, [0, 0.5, 2, 1], space, 1.5, frame);
assert.deepStrictEqual([...heads], ['time [s]', 'x [m]', 'y [m]', 'z [m]', 'diameter [m]', 'speed [m/s]']);
assert.deepStrictEqual(columns.map((c) => c[0]), [1.5, 2, 1, 0.5, 0.02, 0.2]);
// The plane across y at its upper end: the blocks of the second row; a body has neither air nor dust.
Dust.space_dust = {block: (p) => Math.floor(p[0]), value: (code) => (code === 255 ? null : code * 1e-6)};
const plane = Dust.space_tables.plane(space, {t: 2, air: {}, dust: [3, 255], plane: {axis: 1, u: 0, v: 2, at: 1},
  velocity_of: () => (p) => (p[0] < 1 && p[1] > 0 && p[1] < 1 ? [0.5, 0, -0.25] : null)});
assert.deepStrictEqual(plane[1].map((c) => c[0]), [2, 0.5, 1, 0.5, 2, 0, -1, 3]);
assert.deepStrictEqual(plane[1].map((c) => c[1]), [2, 1.5, 1, 0.5, null, null, null, null]);
