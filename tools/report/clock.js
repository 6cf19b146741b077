'use strict';
// The clock that moves all pictures. Space plays and stops, the arrow keys step while the slider has the focus.
(() => {
  // report.html#picture: grains and air speed side by side and nothing else, for documents.
  if (/^#picture/.test(location.hash)) {
    document.documentElement.dataset.view = 'picture';
    const legend = document.getElementById('grains-legend');
    if (legend) document.getElementById('grains-picture').after(legend);
  }
  const times = (Dust.grains || Dust.air || {times: []}).times;
  const nearest = (list, t) => list.reduce((best, value, k) => (Math.abs(value - t) < Math.abs(list[best] - t) ? k : best), 0);
  let wanted = 0, playing = null;
  const show = async (index) => {
    wanted = index;
    const t = times[index];
    const shows = [];
    if (Dust.grains) shows.push(Dust.grains.show(index));
    if (Dust.air) shows.push(Dust.air.show(nearest(Dust.air.times, t)));
    const ready = await Promise.all(shows);
    if (wanted !== index) return;
    // Pictures show grains and air together: all take the new frame before any is drawn.
    for (const shown of ready) shown.take();
    for (const shown of ready) shown.draw();
  };

  if (times.length) {
    const button = Dust.el('button', {type: 'button'}, 'Play');
    const slider = Dust.el('input', {type: 'range', min: 0, max: times.length - 1, step: 1, 'aria-label': 'Time'});
    slider.value = times.length - 1;
    const reading = Dust.el('output', {});
    const go = (index) => {
      slider.value = index;
      slider.setAttribute('aria-valuetext', times[index].toFixed(3) + ' s');
      reading.textContent = 't = ' + times[index].toFixed(3) + ' s';
      return show(+index);
    };
    const stop = () => {
      clearTimeout(playing);
      playing = null;
      button.textContent = 'Play';
    };
    const tick = async (index) => {
      await go(index);
      if (playing === null) return;
      if (index + 1 < times.length) playing = setTimeout(() => tick(index + 1), 90);
      else stop();
    };
    button.addEventListener('click', () => {
      if (playing !== null) return stop();
      button.textContent = 'Pause';
      playing = 0;
      tick(+slider.value >= times.length - 1 ? 0 : +slider.value);
    });
    slider.addEventListener('input', () => {
      if (playing !== null) stop();
      go(+slider.value);
    });
    document.getElementById('clock').append(button, slider, reading);
    document.addEventListener('keydown', (event) => {
      const busy = event.target.closest && event.target.closest('button, a, select, summary, input:not([type="range"])');
      if (event.key !== ' ' || busy || button.disabled) return;
      event.preventDefault();
      button.click();
    });
    if (times.length < 2) button.disabled = slider.disabled = true;
    const asked = /^#(?:picture,)?frame=(\d+)$/.exec(location.hash);
    go(asked ? Math.min(+asked[1], times.length - 1) : times.length - 1)
      .then(() => { document.documentElement.dataset.drawn = 'yes'; });
  } else {
    document.documentElement.dataset.drawn = 'yes';
  }
})();
