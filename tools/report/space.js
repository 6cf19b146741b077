'use strict';
// The run in three dimensions: the figure, its controls and the switch between it and the side view. space_scene.js
// draws into it once it is shown.
Dust.space_figure = ({space, grains, air, kind}) => {
  if (!space || !(grains || space.surfaces)) return null;
  const {el} = Dust;
  const option = (value, text, is_chosen) => el('option', {value, ...(is_chosen ? {selected: ''} : {})}, text);
  const button = (id, text, name) => el('button', {type: 'button', id: 'space-' + id, ...(name ? {'aria-label': name} : {})}, text);
  const box = (id, is_checked, text) => el('label', {}, el('input', {type: 'checkbox', id: 'space-' + id, ...(is_checked ? {checked: ''} : {})}), ' ' + text);
  const has_air = Boolean(space.air || (space.is_thin && air));
  const moved = space.surfaces && space.surfaces.sets.length > 1;
  const thinned = grains && (grains.share < 1 || grains.dust_share < 1);
  const blocks = space.air ? space.air.cells_per_block : [1, 1, 1];
  const notes = [
    'True to scale.',
    grains ? ' Coarse grains are spheres of their size class' + (grains.is_dust.includes(true) ? ', dust is drawn larger than it is.' : '.') : '',
    thinned ? ' Not all grains are shown, see the side view.' : '',
    has_air ? ` Colours in the plane: speed of the air${space.air ? '' : ' averaged over the depth'}; threads follow the air within the plane.` : '',
    space.dust ? ' Dust in the air: all classes together, a faint ball per block from a thousandth of the most upwards; the scale is logarithmic.' : '',
    blocks.some((n) => n > 1) ? ` The air is shown in blocks of ${blocks.join(' × ')} cells.` : '',
    space.surfaces && space.surfaces.coarsened ? ' Fine surfaces are shown coarser than they are.' : '',
    moved ? '' : space.surfaces ? ' Surfaces that only run, as belts do, stay where they are.' : '',
  ];
  const plane = el('span', {class: 'choices screen', role: 'group', 'aria-label': 'Plane of the cut and the air'},
    el('label', {}, 'Plane across ', el('select', {id: 'space-axis'}, option('0', 'x'), option('1', 'y', true), option('2', 'z'))),
    el('label', {class: 'wide'}, 'Place ', el('input', {type: 'range', id: 'space-place', min: 0, max: 1, step: 0.005, value: 0.5})),
    el('output', {id: 'space-at'}),
    el('label', {}, 'Cut away in front ', el('select', {id: 'space-cut'}, option('none', 'nothing', kind === 'setup' || !space.is_thin),
      option('bodies', 'bodies', kind !== 'setup' && space.is_thin), grains ? option('all', 'bodies and grains') : '')),
    has_air ? el('label', {}, 'In the plane ', el('select', {id: 'space-air'}, option('air', 'speed of the air', true), space.dust ? option('dust', 'dust in the air') : '', option('none', 'nothing'))) : '');
  const looks = el('span', {class: 'choices screen', role: 'group', 'aria-label': 'What is shown and from where'},
    grains ? el('label', {}, 'Colour of the grains ', el('select', {id: 'space-colour'}, option('size', 'diameter', true),
      grains.speed > 0 ? option('speed', 'speed') : '')) : '',
    el('label', {class: 'wide'}, 'Bodies ', el('input', {type: 'range', id: 'space-bodies', min: 0, max: 1, step: 0.05, value: kind === 'setup' ? 0.75 : 0.45, 'aria-label': 'How solid bodies look'})),
    space.dust ? box('cloud', true, 'dust in the air') : '', space.dust && space.dust.set_free ? box('origin', false, 'where it came off the load') : '',
    button('slant', 'At a slant'), button('side', 'Side'), button('front', 'Front'), button('top', 'Top'),
    button('nearer', '+', 'Nearer'), button('farther', '−', 'Farther'));
  return el('figure', {id: 'space', hidden: ''}, el('div', {class: 'picture', id: 'space-picture'}), plane, looks,
    el('span', {id: 'space-legend', class: 'key row'}), el('span', {id: 'space-scale', class: 'key'}), el('span', {id: 'space-air-scale', class: 'key'}), el('span', {id: 'space-dust-scale', class: 'key'}),
    el('figcaption', {}, el('b', {}, 'In three dimensions.'), ' ', ...notes.filter(Boolean),
      el('span', {class: 'note screen'}, 'Drag or arrow keys turn, ', el('kbd', {}, 'Shift'), ' with them moves, ', el('kbd', {}, '+'), ' ', el('kbd', {}, '−'),
        ' or the wheel (once the picture has been clicked) look closer, ', el('kbd', {}, 'Home'), ' shows the whole.')));
};

// Two buttons, one of them pressed; the deep domain starts in three dimensions.
Dust.space_switch = ({space}) => {
  const {el} = Dust;
  const button = (id, text) => el('button', {type: 'button', id, 'aria-pressed': 'false'}, text);
  return el('p', {class: 'views screen', role: 'group', 'aria-label': 'View', 'data-first': space.is_thin ? 'side' : 'space'},
    button('view-side', 'From the side'), button('view-space', 'In three dimensions'));
};
