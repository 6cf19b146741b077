'use strict';
// Builds the page: every section that <main data-sections="..."> names, in that order.
(() => {
  const main = document.querySelector('main');
  for (const id of main.dataset.sections.split(/\s+/)) {
    try {
      const section = Dust.sections[id](Dust.data);
      if (section) main.append(section);
    } catch (error) {
      Dust.fail(`section ${id}: ${error.message}`);
      main.append(Dust.p({class: 'banner', role: 'alert'}, `The section '${id}' could not be drawn: ${error.message}`));
    }
  }
  for (const draw of Dust.later) draw();
})();
