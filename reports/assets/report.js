// Draws every <canvas data-chart="id"> from the JSON island of that id, a line per method; and tells of a dot of the
// other pictures which row it is.
(() => {
  'use strict';
  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const colour = (i) => style('--m' + (i % 8));
  // Colours begin again after eight methods: then with other dashes.
  const dashes = (i) => i >= 8 ? [10, 3, 2, 3] : [[], [], [6, 4], [2, 3]][Math.floor(i / 2)];
  const short = (v) => v === 0 ? '0' : Math.abs(v) < 0.001 || Math.abs(v) >= 1e8 ? v.toExponential(1) :
      Number(v.toPrecision(3)).toLocaleString('en', {maximumFractionDigits: 6});

  const numberAxis = (data) => ({
    type: data.logarithmic ? 'logarithmic' : 'linear',
    beginAtZero: !data.logarithmic,
    grid: {color: style('--line'), drawBorder: false},
    ticks: {color: style('--quiet'), maxTicksLimit: 6, maxRotation: 0, callback: (v) =>
        data.logarithmic && !Number.isInteger(Math.log10(v) + 1e-9 - 1e-9) ? '' : short(v)},
  });

  const fit = (axis, data, ends) => {
    if (data.logarithmic) {
      axis.min = 10 ** Math.floor(Math.log10(Math.min(...ends)));
      axis.max = 10 ** Math.ceil(Math.log10(Math.max(...ends)) + 1e-9);
    } else {
      axis.suggestedMin = Math.min(...ends);
      axis.suggestedMax = Math.max(...ends);
    }
    return axis;
  };

  const common = () => ({
    responsive: true, maintainAspectRatio: false, animation: false,
    plugins: {legend: {display: false}, tooltip: {displayColors: false}},
  });
  const legend = () => ({display: true, position: 'top', align: 'start',
    labels: {usePointStyle: true, color: style('--ink'), boxHeight: 7}});
  const curves = (data) => {
    const options = common();
    const all = data.methods.flatMap((m) => m.values);
    options.scales = {
      x: {type: 'linear', min: 0, grid: {display: false, drawBorder: false}, ticks: {color: style('--quiet'), maxTicksLimit: 6},
        title: {display: true, text: data.axis, color: style('--quiet')}},
      y: fit(numberAxis(data), data, all),
    };
    options.plugins.legend = legend();
    options.plugins.legend.labels.pointStyle = 'line';
    options.interaction = {mode: 'nearest', axis: 'x', intersect: false};
    options.plugins.tooltip.callbacks = {title: (c) => c.length ? data.axis + ' ' + c[0].parsed.x : '',
      label: (c) => c.dataset.label + ': ' + short(c.parsed.y) + data.suffix};
    return {type: 'line', options, data: {datasets: data.methods.map((method, i) => ({
      label: method.name, borderColor: colour(i), backgroundColor: colour(i), borderWidth: 2, pointRadius: 0, tension: 0.15,
      borderDash: dashes(i), data: method.values.map((y, k) => ({x: k * data.stride, y}))}))}};
  };

  const charts = [];
  const draw = () => {
    charts.splice(0).forEach((chart) => chart.destroy());
    Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
    Chart.defaults.font.size = 13;
    document.querySelectorAll('canvas[data-chart]').forEach((canvas) => {
      const data = JSON.parse(document.getElementById(canvas.dataset.chart).textContent);
      charts.push(new Chart(canvas, curves(data)));
    });
  };
  draw();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);

  // A dot's row: which cells it shows, their values, and how to run them again.
  const card = document.createElement('div');
  card.className = 'row-card';
  card.setAttribute('role', 'status');
  card.hidden = true;
  document.body.append(card);
  let picked = null;
  const close = () => { card.hidden = true; picked?.classList.remove('picked'); picked = null; };
  const line = (tag, text) => { const e = document.createElement(tag); e.textContent = text; card.append(e); return e; };
  const show = (dot) => {
    close();
    const figure = dot.closest('figure'), of = figure.dataset, trial = dot.dataset.t.padStart(3, '0');
    const methods = of.a ? [of.a, of.b] : [dot.parentElement.dataset.m];
    const ids = methods.map((m) => [of.s, of.c, trial, m].join('/'));
    card.replaceChildren();
    const titled = figure.querySelector('use[data-t="' + dot.dataset.t + '"] title');
    line('p', titled?.textContent ?? 'trial ' + Number(trial));
    ids.forEach((id) => line('code', "etude replay DIR --cell '" + id.replaceAll("'", "'\\''") + "'"));
    const seen = ids.filter((id) => window.etudeViewer?.has(id));
    if (seen.length) {
      const watch = line('button', 'Watch the motion');
      watch.className = 'watched';
      watch.dataset.cell = seen[0];
      watch.dataset.others = JSON.stringify(seen.slice(1));
    }
    const article = figure.closest('.card');
    const film = article.querySelector('.film') ?? document.querySelector('.film');
    if (film && ids.some((id) => JSON.parse(article.dataset.recorded ?? '[]').includes(id))) {
      const link = line('a', 'It was recorded: to the film');
      film.id ||= 'film-' + of.s;
      link.href = '#' + film.id;
    }
    const button = line('button', '×');
    button.setAttribute('aria-label', 'Close');
    button.addEventListener('click', close);
    card.hidden = false;
    picked = dot;
    dot.classList.add('picked');
  };
  document.addEventListener('click', (event) => {
    const dot = event.target.closest?.('use[data-t]');
    if (dot) show(dot);
  });
  document.addEventListener('keydown', (event) => { if (event.key === 'Escape') close(); });

  const video = document.querySelector('video');
  if (video && matchMedia('(prefers-reduced-motion: reduce)').matches) { video.autoplay = false; video.pause(); }
})();
