'use strict';
// Numbers and names as on paper: a true minus, thousands apart, an error with two digits, units that
// suit the size. Knows nothing of the page: tests/report/numbers_test.mjs runs it by itself.
const Numbers = (() => {
  const thin = '\u202f', minus = '\u2212', dash = '\u2013', plus_minus = '\u00a0±\u00a0';
  const signed = (text) => text.replace(/^-/, minus);
  const raised = (exponent) => String(exponent).replace('-', '⁻').replace(/\d/g, (d) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[d]);

  const count = (value) => {
    if (!Number.isFinite(value)) return dash;
    return signed(value.toFixed(0)).replace(/\B(?=(\d{3})+$)/g, thin);
  };
  const number = (value, digits = 4) => {
    if (value === null || value === undefined || Number.isNaN(value)) return dash;
    if (!Number.isFinite(value)) return value > 0 ? '∞' : minus + '∞';
    const size = Math.abs(value);
    if (size !== 0 && (size < 1e-3 || size >= 1e6)) {
      const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
      return `${signed(String(+mantissa))}${thin}×${thin}10${raised(+exponent)}`;
    }
    // More figures before the point than asked for: still the whole number, not a power of ten.
    if (size >= 10 ** digits) return count(value);
    return signed(String(+value.toPrecision(digits)));
  };
  // "12.34 ± 0.56": the error with two digits, the value cut at the same place.
  const value = (mean, error) => {
    if (!(error > 0) || !Number.isFinite(error) || !Number.isFinite(mean)) return number(mean);
    const place = Math.floor(Math.log10(error)) - 1;
    const size = Math.max(Math.abs(mean), error);
    // Digits that the error does not bear out are zeros.
    const whole = (v) => count(Math.round(v / 10 ** place) * 10 ** place);
    const fixed = (v, decimals) => (decimals < 0 ? whole(v) : signed(v.toFixed(Math.min(decimals, 8))));
    if (size >= 1e6 || size < 1e-3) {
      const exponent = Math.floor(Math.log10(size)), unit = 10 ** exponent;
      if (exponent - place > 8) return number(mean, 9) + plus_minus + number(error, 2);  // an error of rounding
      return `(${fixed(mean / unit, exponent - place)}${plus_minus}${fixed(error / unit, exponent - place)})${thin}×${thin}10${raised(exponent)}`;
    }
    if (place < -8) return number(mean, 9) + plus_minus + number(error, 2);  // an error of rounding
    return fixed(mean, -place) + plus_minus + fixed(error, -place);
  };

  // So many digits behind the point that ascending times differ; three at least.
  const decimals_of = (times) => {
    const steps = times.slice(1).map((t, k) => t - times[k]).filter((step) => step > 0);
    return steps.length ? Math.min(12, Math.max(3, Math.ceil(-Math.log10(Math.min(...steps)) - 1e-9))) : 3;
  };

  // From this extent [m] on a domain is a plant's: places in m, flows in t/h.
  const plant_extent = 2;
  let is_plant = false;
  const set_extent = (extent) => { is_plant = extent >= plant_extent; };
  // The one unit of all places of a domain, so that they compare.
  const place_unit = (extent) => (extent >= plant_extent ? {unit: 'm', factor: 1} : extent >= 1e-3 || !(extent > 0) ? {unit: 'mm', factor: 1e-3} : {unit: 'µm', factor: 1e-6});

  // The scales of a unit, largest first. Amounts per tonne in two steps only: rows shall compare.
  const ladders = {
    'm': [['m', 1], ['mm', 1e-3], ['µm', 1e-6]],
    's': [['s', 1], ['ms', 1e-3], ['µs', 1e-6]],
    'kg': [['t', 1e3], ['kg', 1], ['g', 1e-3], ['mg', 1e-6], ['µg', 1e-9], ['ng', 1e-12]],
    'kg/s': [['kg/s', 1], ['g/s', 1e-3], ['mg/s', 1e-6], ['µg/s', 1e-9], ['ng/s', 1e-12]],
    'kg/m3': [['kg/m³', 1], ['g/m³', 1e-3], ['mg/m³', 1e-6], ['µg/m³', 1e-9], ['ng/m³', 1e-12]],
    'm3/s': [['m³/h', 1 / 3600], ['l/min', 1 / 6e4], ['l/h', 1e-3 / 3600], ['cm³/h', 1e-6 / 3600], ['mm³/h', 1e-9 / 3600]],
    'kg/(m2 s)': [['kg/(m² s)', 1], ['g/(m² s)', 1e-3], ['mg/(m² s)', 1e-6]],
    'g/t': [['g/t', 1], ['mg/t', 1e-3]],
    'kg/h': [['t/h', 1e3], ['kg/h', 1], ['g/h', 1e-3], ['mg/h', 1e-6], ['µg/h', 1e-9]],
    'rad': [['°', Math.PI / 180]],
    // A pressure of the air stays in Pa; a third number is from where on a unit is used.
    'Pa': [['GPa', 1e9], ['MPa', 1e6], ['kPa', 1e3], ['Pa', 1, 0]],
    'm/s': [['m/s', 1, 1e-3], ['mm/s', 1e-3, 1e-6], ['µm/h', 1e-6 / 3600, 0]],
    'J': [['J', 1], ['mJ', 1e-3], ['µJ', 1e-6], ['nJ', 1e-9]],
  };
  const is_bare = (unit) => !unit || unit === '1' || unit === '-';
  const raise = (unit) => (is_bare(unit) ? '' : unit.replace(/m3/g, 'm³').replace(/m2/g, 'm²').replace(/s2/g, 's²'));
  const scale = (unit, largest) => {
    const tonne_per_hour = 1 / 3.6;  // [kg/s]
    if (is_plant && unit === 'kg/s' && largest >= tonne_per_hour) return {factor: tonne_per_hour, unit: 't/h'};
    const ladder = ladders[unit];
    if (!ladder) return {factor: 1, unit: raise(unit)};
    const [name, factor] = ladder.find((step) => largest >= (step[2] ?? step[1])) || (largest > 0 ? ladder.at(-1) : ladder[0]);
    return {factor, unit: name};
  };
  const quantity = (mean, error, unit) => {
    if (mean === null || mean === undefined || Number.isNaN(mean)) return dash;
    // In what unit a plain zero is, nobody asks where the others choose their own.
    if (mean === 0 && !(error > 0) && ladders[unit]) return '0';
    const best = scale(unit, Math.max(Math.abs(mean), error > 0 ? error : 0));
    const text = value(mean / best.factor, error > 0 ? error / best.factor : -1);
    return best.unit === '°' ? text + '°' : best.unit ? text + thin + best.unit : text;
  };
  const duration = (seconds) => {
    if (!Number.isFinite(seconds) || seconds < 0) return dash;
    if (seconds < 100) return number(seconds, 3) + thin + 's';
    const steps = [[86400, 'd', 3600, 'h'], [3600, 'h', 60, 'min'], [60, 'min', 1, 's']];
    const [large, name, small, part] = steps.find(([size]) => seconds >= size);
    const whole = Math.floor(seconds / large), rest = Math.floor((seconds - whole * large) / small);
    return `${whole}${thin}${name} ${String(rest).padStart(2, '0')}${thin}${part}`;
  };
  // A share of one in per cent.
  const percent = (share, digits = 2) => (share > 0 && share < 1e-4 ? `<${thin}0.01` : number(100 * share, digits)) + thin + '%';
  const width = (share) => (100 * Math.min(Math.max(share, 0), 1)).toFixed(1) + '%';

  // Positive numbers that grow by about the same factor each time, over three powers of ten and more.
  const is_geometric = (list) => {
    const n = list.length;
    if (n < 6 || !(list[0] > 0) || !(list[n - 1] / list[0] >= 1e3)) return false;
    const step = Math.log(list[n - 1] / list[0]) / (n - 1);
    return list.every((v, k) => k === 0 || Math.abs(Math.log(v / list[k - 1]) - step) < 0.2 * step);
  };
  const words = (name) => String(name).replace(/_/g, ' ').replace(/ um(?=$|\W)/g, ' µm').replace(/(\w)\/([a-z]{3,})/g, '$1 / $2');  // m/s stays
  // A word of small letters begins with a large one; TP7, tp7 and mDust stay as someone wrote them.
  const sentence = (name) => words(name).replace(/^\p{Ll}(?=\p{Ll}*(?![\p{L}\p{N}]))/u, (c) => c.toUpperCase());
  const plural = (n, one, many = one + 's') => `${count(n)} ${n === 1 ? one : many}`;
  return {is_geometric, decimals_of, set_extent, place_unit, number, count, value, quantity, scale, raise, is_bare, duration, percent, width, words, sentence, plural, thin, dash};
})();
if (typeof module !== 'undefined') module.exports = Numbers;
