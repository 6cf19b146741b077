'use strict';
// The run in pictures: the frames that grains.js and air.js draw into.
Dust.sections.pictures = (data) => {
  const {grains, air, extraction} = data;
  if (!grains && !air) return null;
  const {el, p} = Dust;
  const has_places = Boolean(extraction);
  const frames_note = (set) => (set.frames.length < set.written ? ` ${set.frames.length} of ${Dust.count(set.written)} frames are shown.` : '');
  const box = (id, is_checked, text) => el('label', {class: 'screen'}, el('input', {type: 'checkbox', id, ...(is_checked ? {checked: ''} : {})}), ' ' + text);

  const grains_figure = () => {
    const has_dust = grains.is_dust.includes(true);
    let note = '';
    if (grains.share < 1) note += ` One coarse grain in ${Dust.number(1 / grains.share, 3)} is shown (up to ${Dust.count(grains.most)} per frame were computed).`;
    if (grains.dust_share < 1) note += ` One dust grain in ${Dust.number(1 / grains.dust_share, 3)} is shown.`;
    const choice = el('select', {id: 'grains-colour'}, el('option', {value: 'size'}, 'diameter'), grains.speed > 0 ? el('option', {value: 'speed'}, 'speed') : '');
    return el('figure', {id: 'grains', class: 'side'}, el('div', {class: 'picture', id: 'grains-picture'}), el('figcaption', {}, el('b', {}, 'From the side'),
      `, ${air ? 'grains and air' : 'the grains'}. Seen along y, true to scale.`,
      has_dust ? ` Dust (finer than ${Dust.quantity(grains.dust_below, -1, 'm')}) is drawn larger than it is, on top, with its path over the last frames.` : '', note + frames_note(grains),
      el('span', {class: 'choices screen'}, el('label', {}, 'Colour of the grains ', choice), air ? box('grains-air', true, 'speed of the air behind them') : ''),
      el('span', {id: 'grains-legend', class: 'key'}), el('span', {id: 'grains-scale', class: 'key'}), el('span', {id: 'grains-air-scale', class: 'key'}),
      el('span', {id: 'grains-count', class: 'note'}),
      el('span', {class: 'note screen'}, 'Double-click or ', el('kbd', {}, '+'), ' to look closer, drag or arrow keys to move. ', el('button', {type: 'button', id: 'grains-whole'}, 'Whole view'))));
  };
  const air_figures = () => {
    const depth = air.middle ? 'in the middle plane' : 'averaged over the depth y';
    const figure = (id, ...caption) => el('figure', {id}, el('div', {class: 'picture', id: id + '-picture'}), el('div', {id: id + '-legend', class: 'key'}), el('figcaption', {}, ...caption));
    const speed = figure('speed', el('b', {}, 'Speed of the air'), ` ${depth}, in m/s. The threads follow the air for a short while, longer where it is faster; their thick end leads. Highest speed of all `
      + `frames: ${Dust.number(air.top_speed, 3)}\u202fm/s; the colours follow the root of the speed, so that slow air shows, and end at ${Dust.number(air.speed, 3)}\u202fm/s (99.8\u202f% of the cells of the `
      + `fullest frame lie below).${frames_note(air)} `, box('air-dust', true, 'show the dust'), ' ', box('air-mean', false, 'mean over the second half of the run instead of one moment'));
    const pressure = figure('pressure', el('b', {}, 'Pressure of the air'), ` ${depth}, in Pa, without the hydrostatic part. `
      + (has_places ? 'Numbered rings: the places of low mean pressure listed above; eddies wander, so look at them in the mean (switch in the figure before). ' : 'The ring marks the lowest pressure of the frame. ')
      + `Range over all frames: ${Dust.number(air.low, 3)}\u202fPa to ${Dust.number(air.high, 3)}\u202fPa.`);
    return el('div', {class: 'pair'}, speed, pressure);
  };
  const space = Dust.space_figure(data);
  return Dust.section('pictures', 'The run in pictures', el('div', {id: 'clock', class: 'clock screen'}), space ? Dust.space_switch(data) : null,
    grains ? grains_figure() : null, space, air ? air_figures() : null);
};
