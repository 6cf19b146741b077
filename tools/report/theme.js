'use strict';
// Light or dark: the reader's system decides until the button does; paper is always light.
(() => {
  const system = window.matchMedia('(prefers-color-scheme: dark)');
  const of_system = () => (system.matches ? 'dark' : 'light');
  let chosen = null;
  Dust.set_theme(of_system());
  system.addEventListener('change', () => { if (!chosen) Dust.set_theme(of_system()); });
  document.getElementById('theme').addEventListener('click', () => {
    chosen = Dust.theme() === 'dark' ? 'light' : 'dark';
    Dust.set_theme(chosen);
  });
  window.addEventListener('beforeprint', () => {
    Dust.on_paper = true;  // a page has no window that a picture shall fit into
    Dust.set_theme('light');
  });
  window.addEventListener('afterprint', () => {
    Dust.on_paper = false;
    Dust.set_theme(chosen || of_system());
  });
  // Pages without a clock have nothing else to wait for, unless they say so.
  if (!document.getElementById('clock') && !Dust.is_drawing) document.documentElement.dataset.drawn = 'yes';
})();
