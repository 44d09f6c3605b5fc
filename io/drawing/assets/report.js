// Shows the cells of a dot or a row, and the command that runs these cells again. Sorts, filters and copies tables; saves
// pictures.
(() => {
  'use strict';
  const make = (tag, text, properties = {}) => Object.assign(document.createElement(tag), {textContent: text, ...properties});
  const button = (text, label, use, style = '') => {
    const made = make('button', text, {type: 'button', className: style, onclick: use});
    if (label) made.setAttribute('aria-label', label);
    return made;
  };
  document.documentElement.classList.add('js');

  // The card of a dot or row shows its cells, and the command `etude replay` that runs these cells again. `folder` is
  // the run's folder in this command.
  const folder = location.protocol === 'file:' ? decodeURIComponent(location.pathname).replace(/\/report\/[^/]*$/, '') : '.';
  const word = (text) => /^[\w.\/=,:@%+-]+$/.test(text) ? text : "'" + text.replaceAll("'", "'\\''") + "'";
  const card = make('div', '', {className: 'row-card', hidden: true});
  card.setAttribute('role', 'dialog');
  card.setAttribute('aria-label', 'Cells');
  document.body.append(card);
  let picked = null;
  const close = () => {
    if (card.hidden) return;
    const back = card.contains(document.activeElement) ? picked : null;
    card.hidden = true;
    picked?.classList.remove('picked');
    picked = null;
    back?.focus();
  };
  // The cells of a table row differ only in their trial, so compare them without the trial's number.
  const TRIAL = /\/\d+(?=\/[^/]*$)/, without = (id) => id.replace(TRIAL, '');
  const ofRow = (ids, kept) => {
    const asked = ids.map(without), count = new Map();
    kept.filter((id) => asked.includes(without(id))).forEach((id) => {
      const [trial] = id.match(TRIAL);
      count.set(trial, (count.get(trial) ?? 0) + 1);
    });
    const most = Math.max(...count.values()), trial = [...count.keys()].find((one) => count.get(one) === most);
    return trial ? ids.map((id) => id.replace(TRIAL, trial)) : ids;
  };
  const cellsOf = (shown, kept) => {
    if (shown.dataset.ids) return shown.tagName === 'TR' ? ofRow(shown.dataset.ids.split('\n'), kept) : shown.dataset.ids.split('\n');
    const of = shown.closest('figure').dataset, trial = shown.dataset.t.padStart(3, '0');
    return (of.a ? [of.a, of.b] : [shown.parentElement.dataset.m]).map((m) => [of.s, of.c, trial, m].join('/'));
  };
  const told = (dot) => [dot.parentElement.dataset.m, 'trial ' + Number(dot.dataset.t)].filter(Boolean).join(', ') + (dot.dataset.v ? ': ' + dot.dataset.v : '');
  const titleOf = (shown) => {
    if (shown.dataset.ids) return shown.innerText.replace(/\s+/g, ' ').trim();
    const titled = shown.closest('figure').querySelector('use[data-t="' + shown.dataset.t + '"] title');
    return titled?.textContent ?? told(shown);
  };
  const show = (shown) => {
    close();
    const article = shown.closest('.card'), kept = JSON.parse(article.dataset.recorded ?? '[]');
    const cells = cellsOf(shown, kept);
    card.replaceChildren(make('p', titleOf(shown)));
    cells.forEach((id) => card.append(make('code', 'etude replay ' + word(folder) + ' --cell ' + word(id))));
    const film = article.querySelector('.film') ?? document.querySelector('.film');
    if (film && cells.some((id) => kept.includes(id))) {
      film.id ||= 'film-of-' + article.id;
      card.append(make('a', 'Recorded: go to the film', {href: '#' + film.id, onclick: () => film.closest('details')?.setAttribute('open', '')}));
    }
    const end = button('×', 'Close', close);
    card.append(end);
    card.hidden = false;
    picked = shown;
    shown.classList.add('picked');
    // Other scripts may add to the card, such as one that shows the motion of a recorded cell.
    card.dispatchEvent(new CustomEvent('etude:cells', {bubbles: true, detail: {cells, kept: cells.filter((id) => kept.includes(id)), card}}));
    card.querySelector('button').focus();  // focus the button that shows the motion, else the close button
  };
  document.addEventListener('click', (event) => {
    const dot = event.target.closest?.('use[data-t]'), row = event.target.closest?.('tr[data-ids]');
    if (dot) show(dot);
    else if (row?.dataset.ids && !event.target.closest('a, button') && getSelection().isCollapsed) show(row);
  });
  document.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape') return;
    close();
    document.querySelectorAll('.menu').forEach((menu) => {
      if (menu.contains(document.activeElement)) menu.parentElement.querySelector('.columns').focus();
      menu.remove();
    });
  });

  // The Tab key stops once per picture; the arrow keys move from dot to dot, and Enter opens a dot.
  document.querySelectorAll('figure svg').forEach((svg) => {
    const dots = [...svg.querySelectorAll('use[data-t]')];
    if (!dots.length) return;
    svg.setAttribute('role', 'group');
    dots.forEach((dot, i) => {
      dot.setAttribute('tabindex', i ? '-1' : '0');
      dot.setAttribute('role', 'button');
      if (!dot.querySelector('title')) dot.setAttribute('aria-label', told(dot));
    });
    svg.addEventListener('keydown', (event) => {
      const at = dots.indexOf(document.activeElement);
      if (at < 0) return;
      const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
      if (event.key === 'Enter' || event.key === ' ') show(dots[at]);
      else if (step) {
        const next = dots[(at + step + dots.length) % dots.length];
        dots[at].setAttribute('tabindex', '-1');
        next.setAttribute('tabindex', '0');
        next.focus();
      } else return;
      event.preventDefault();
    });
  });
  document.querySelectorAll('tr[data-ids], li[data-ids]').forEach((row) => {
    if (row.dataset.ids) (row.tagName === 'TR' ? row.cells[0] : row).append(button('', 'Run it again', () => show(row), 'rerun'));
  });

  // A picture is saved as a file with the colours of the screen and the marks that it uses; or it is printed alone on a
  // page of its own size, and the browser can save that page as a PDF of vector graphics.
  const PAINTS = ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'fill-opacity', 'stroke-opacity', 'opacity', 'font-size', 'font-family', 'paint-order'];
  const whole = (svg) => {
    const copy = svg.cloneNode(true), there = svg.querySelectorAll('*');
    copy.querySelectorAll('*').forEach((e, i) => {
      const style = getComputedStyle(there[i]);
      PAINTS.forEach((p) => e.style.setProperty(p, style.getPropertyValue(p)));
    });
    copy.prepend(document.querySelector('.defs defs').cloneNode(true));
    copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
    return copy;
  };
  const save = (svg, name) => {
    const url = URL.createObjectURL(new Blob([new XMLSerializer().serializeToString(whole(svg))], {type: 'image/svg+xml'}));
    make('a', '', {href: url, download: name + '.svg'}).click();
    setTimeout(() => URL.revokeObjectURL(url), 1000);
  };
  const print = (svgs) => {
    const frame = make('iframe', '', {className: 'print', title: 'The picture to print'});
    document.querySelector('.print')?.remove();
    document.body.append(frame);
    const boxes = svgs.map((svg) => svg.getBoundingClientRect()), inside = frame.contentDocument;
    const width = Math.ceil(Math.max(...boxes.map((box) => box.width))) + 24, height = Math.ceil(Math.max(...boxes.map((box) => box.height))) + 24;
    inside.head.append(make('style', `@page { size: ${width}px ${height}px; margin: 0 } body { margin: 12px; -webkit-print-color-adjust: exact; print-color-adjust: exact }
        svg { display: block; break-inside: avoid; break-after: page } svg:last-child { break-after: auto }`));
    svgs.forEach((svg, i) => {
      const copy = whole(svg);
      copy.setAttribute('width', boxes[i].width);
      copy.setAttribute('height', boxes[i].height);
      inside.body.append(copy);
    });
    inside.title = document.title;
    frame.dispatchEvent(new CustomEvent('etude:printed', {bubbles: true}));
    frame.contentWindow.print();
  };
  document.querySelectorAll('figure:has(> svg, .panels svg) > figcaption').forEach((caption, i) => {
    const figure = caption.parentElement, svgs = [...figure.querySelectorAll('svg')];
    caption.append(button('', 'Save this picture as SVG', () => svgs.forEach((svg, k) => save(svg, [figure.dataset.s ?? 'picture', i + 1, k + 1].join('-'))), 'save'),
                   button('', 'Print this picture alone, or save it as PDF', () => print(svgs), 'save pdf'));
  });

  // Tables can be sorted by a click on a heading, filtered and copied; the reader chooses their columns.
  const LATEX = {'\\': '\\textbackslash{}', '~': '\\textasciitilde{}', '^': '\\textasciicircum{}', '<': '\\textless{}', '>': '\\textgreater{}', '|': '\\textbar{}',
                 '−': '$-$', '–': '--', '°': '$^\\circ$', '±': '$\\pm$', '×': '$\\times$', '≤': '$\\le$', '≥': '$\\ge$', '“': '``', '”': "''", '’': "'", '…': '\\dots{}',
                 '↓': '$\\downarrow$', '↑': '$\\uparrow$', '▲': '$\\bigtriangleup$', '▼': '$\\bigtriangledown$'};
  const ESCAPES = {
    TSV: (text) => /^[=+@-]/.test(text) && isNaN(text) ? "'" + text : text,  // a spreadsheet runs formulas
    Markdown: (text) => text.replace(/[\\`*_[\]<>#|&$~]/g, '\\$&'),
    LaTeX: (text) => text.replace(/[\\{}&%$#_]|[^\x20-\x7e]|[~^<>|]/gu, (c) => LATEX[c] ?? (c < '\x7f' ? '\\' + c : c)),
  };
  const ROWS = {
    TSV: (rows) => rows.map((row) => row.join('\t')),
    Markdown: (rows) => rows.map((row) => '| ' + row.join(' | ') + ' |').toSpliced(1, 0, '|' + rows[0].map(() => '---|').join('')),
    LaTeX: (rows) => ['\\begin{tabular}{' + rows[0].map(() => 'l').join('') + '}', '\\toprule', ...rows.map((row) => row.join(' & ') + ' \\\\').toSpliced(1, 0, '\\midrule'),
                      '\\bottomrule', '\\end{tabular}'],
  };
  const visible = (cell) => !cell.classList.contains('off') && (!cell.classList.contains('more') || cell.classList.contains('shown'));
  const textOf = (cell) => cell.innerText.replace(/\s+/g, ' ').trim();
  const copy = (table, as) => {
    const groups = table.querySelector('[data-group]');
    const cells = (row, before) => [...(groups ? [before] : []), ...[...row.cells].filter(visible).map(textOf)].map(ESCAPES[as]);
    const rows = [cells(table.tHead.rows[0], 'Metric')];
    for (const body of table.tBodies) {
      for (const row of body.rows) if (!row.hidden && !row.classList.contains('group')) rows.push(cells(row, body.dataset.group));
    }
    const text = ROWS[as](rows).join('\n') + '\n';
    table.dispatchEvent(new CustomEvent('etude:copied', {bubbles: true, detail: text}));
    const put = navigator.clipboard?.writeText(text) ?? Promise.reject();
    return put.then(() => 'copied', () => 'the browser forbids it');
  };
  const keyOf = (row, column) => {
    const cell = row.cells[column], value = cell?.dataset.v;
    return value === undefined ? textOf(cell) : value === '' ? Infinity : Number(value);
  };
  const sort = (table, head, column) => {
    const was = head.getAttribute('aria-sort');
    for (const other of table.tHead.rows[0].cells) other.removeAttribute('aria-sort');
    const way = was === 'ascending' ? -1 : was === 'descending' ? 0 : 1;
    if (way) head.setAttribute('aria-sort', way > 0 ? 'ascending' : 'descending');
    for (const body of table.tBodies) {
      const rows = [...body.rows].filter((row) => !row.classList.contains('group'));
      rows.forEach((row, i) => row.dataset.at ??= i);
      const compare = (a, b) => {
        const x = keyOf(a, column), y = keyOf(b, column);
        // missing values come last in both orders
        if (x === Infinity || y === Infinity) return (x === Infinity) - (y === Infinity);
        return way * (typeof x === 'number' ? x - y : x.localeCompare(y, 'en', {numeric: true}));
      };
      rows.sort((a, b) => (way && compare(a, b)) || a.dataset.at - b.dataset.at);
      body.append(...rows);
    }
  };
  const choose = (table, tools) => {
    if (tools.querySelector('.menu')) return tools.querySelector('.menu').remove();
    const menu = make('div', '', {className: 'menu'});
    [...table.tHead.rows[0].cells].forEach((head, column) => {
      if (!column) return;
      const box = make('input', '', {type: 'checkbox', checked: visible(head)});
      box.onchange = () => {
        for (const row of table.rows) {
          const cell = row.cells[column];
          if (!cell || row.classList.contains('group')) continue;
          cell.classList.toggle('shown', box.checked);
          cell.classList.toggle('off', !box.checked);
        }
      };
      const label = make('label', '');
      label.append(box, ' ' + head.textContent);
      menu.append(label);
    });
    tools.append(menu);
    menu.querySelector('input')?.focus();
  };
  document.querySelectorAll('table.data').forEach((table) => {
    const scroll = table.closest('.scroll'), tools = make('div', '', {className: 'tools'});
    const filter = make('input', '', {type: 'search', placeholder: 'Filter'});
    filter.setAttribute('aria-label', 'Filter rows');
    filter.oninput = () => {
      const wanted = filter.value.toLowerCase().split(/\s+/);
      for (const body of table.tBodies) {
        for (const row of body.rows) {
          const text = ((body.dataset.group ?? '') + ' ' + row.textContent).toLowerCase();
          row.hidden = !row.classList.contains('group') && !wanted.every((part) => text.includes(part));
        }
        body.hidden = [...body.rows].every((row) => row.hidden || row.classList.contains('group'));
      }
    };
    const told = make('output', '');
    const copied = async (as) => { told.textContent = as + ': ' + await copy(table, as); };
    tools.append(filter, ...Object.keys(ROWS).map((as) => button(as, 'Copy as ' + as, () => copied(as))));
    if (table.tHead.rows[0].cells.length > 3) tools.append(button('Columns', '', () => choose(table, tools), 'columns'));
    tools.append(told);
    scroll.before(tools);
    [...table.tHead.rows[0].cells].forEach((head, column) => {
      const by = button('', '', () => sort(table, head, column), 'sort');
      by.append(...head.childNodes);
      head.append(by);
    });
  });

  const video = document.querySelector('video');
  if (video && matchMedia('(prefers-reduced-motion: reduce)').matches) { video.autoplay = false; video.pause(); }
})();
