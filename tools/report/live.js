'use strict';
// Watches a run: asks how far it is each second and shows its report anew after a frame.
(() => {
  const by_id = (id) => document.getElementById(id);
  const report = by_id('report');
  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  const take_theme = () => { document.documentElement.dataset.theme = dark.matches ? 'dark' : 'light'; };
  dark.addEventListener('change', take_theme);
  take_theme();

  report.hidden = true;
  const rest = 10000;  // between two pages [ms]: a reader shall have time to look
  let shown = 0, shown_at = 0, newest = 0, is_over = false;
  const load = () => {
    // The view that the reader has chosen stays: the page opens with it.
    const pressed = report.contentDocument && report.contentDocument.querySelector('.views [aria-pressed="true"]');
    const view = pressed ? '#' + pressed.id.replace('view-', '') : '';
    const place = report.contentWindow && !report.hidden ? report.contentWindow.scrollY : 0;
    report.onload = () => report.contentWindow.scrollTo(0, place);
    shown = newest;
    shown_at = Date.now();
    by_id('nothing').hidden = true;
    report.hidden = false;
    report.src = `/report.html?state=${shown}${view}`;
  };
  const tell = (run) => {
    newest = run.states || 0;
    document.title = by_id('title').textContent = run.scenario || 'A run that goes on';
    const share = run.end_s > 0 ? Math.min(1, run.time_s / run.end_s) : 0;
    by_id('share').value = share;
    by_id('status').textContent = run.status;
    by_id('status').className = 'status ' + (run.status === 'failed' || run.status === 'interrupted' ? 'bad' : 'good');
    const parts = [`${(100 * share).toFixed(1)} %`, `${Numbers.number(run.time_s, 4)} of ${Numbers.number(run.end_s, 4)} s`,
      `${Numbers.count(run.particles)} grains`, `${Numbers.count(run.frames)} frames`];
    if (run.left_s !== null && run.status === 'running') parts.push(`${Numbers.number(run.pace, 2)} s per simulated second`, `ends in ${Numbers.duration(run.left_s)}`);
    if (run.reason) parts.push(run.reason);
    by_id('reading').textContent = parts.join(' · ');
    by_id('warnings').replaceChildren(...(run.warnings || []).map((text) => Object.assign(document.createElement('li'), {textContent: text})));
    by_id('warnings').hidden = !(run.warnings || []).length;
    is_over = run.status !== 'running';
    document.documentElement.dataset.states = newest;
    if (newest > shown && by_id('follow').checked && (shown === 0 || Date.now() - shown_at > rest)) load();
  };
  by_id('newest').addEventListener('click', () => { if (newest > 0) load(); });
  let folder = '';
  const ask = async () => {
    try {
      const run = await (await fetch('/progress.json')).json();
      if (run.status) {
        folder = run.folder;
        tell(run);
      }
    } catch (error) {
      by_id('status').textContent = is_over ? 'ended' : 'gone';
      by_id('reading').textContent = `The engine no longer answers: the run has ended.${folder ? ` Its report is ${folder}/report.html.` : ''}`;
      return;
    }
    setTimeout(ask, 1000);
  };
  ask();
})();
