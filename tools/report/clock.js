'use strict';
// A clock for the pictures of a page: `Dust.clock(times, show, first)` puts play, slider and time into #clock and
// asks `show(index)`, which may take its time, for each frame. Space plays and stops, the arrow keys step while
// the slider has the focus.
Dust.clock = (times, show, first = times.length - 1) => {
  let playing = null;
  const button = Dust.el('button', {type: 'button'}, 'Play');
  const slider = Dust.el('input', {type: 'range', min: 0, max: times.length - 1, step: 1, 'aria-label': 'Time'});
  const reading = Dust.el('output', {});
  const decimals = Dust.decimals_of(times);
  const go = (index) => {
    slider.value = index;
    slider.setAttribute('aria-valuetext', times[index].toFixed(decimals) + ' s');
    reading.textContent = 't = ' + times[index].toFixed(decimals) + ' s';
    return show(index);
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
  go(first).then(() => { document.documentElement.dataset.drawn = 'yes'; });
};
