// Draws every <canvas data-chart="id"> from the JSON island of that id. Two kinds: "intervals" (a dot with
// its whisker per method and condition) and "curves" (one line per method).
(() => {
  'use strict';
  const shapes = ['circle', 'rectRot', 'triangle', 'rect', 'star', 'crossRot', 'rectRounded', 'cross'];
  const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const colour = (i) => style('--m' + (i % 8));
  // Colours begin again after eight methods: then with other shapes and dashes.
  const shape = (i) => shapes[(i + Math.floor(i / 8)) % 8];
  const dashes = (i) => i >= 8 ? [10, 3, 2, 3] : [[], [], [6, 4], [2, 3]][Math.floor(i / 2)];
  const short = (v) => v === 0 ? '0' : Math.abs(v) < 0.001 || Math.abs(v) >= 1e8 ? v.toExponential(1) :
      Number(v.toPrecision(3)).toLocaleString('en', {maximumFractionDigits: 6});

  // A line from low to high through each dot, with the dot's own colour.
  const whiskers = {
    id: 'whiskers',
    beforeDatasetsDraw(chart) {
      const {ctx, chartArea: area, options} = chart;
      const flat = options.indexAxis === 'y';
      const scale = flat ? chart.scales.x : chart.scales.y;
      ctx.save();
      ctx.beginPath();
      ctx.rect(area.left, area.top, area.right - area.left, area.bottom - area.top);
      ctx.clip();
      chart.data.datasets.forEach((set, d) => {
        if (!chart.isDatasetVisible(d)) return;
        chart.getDatasetMeta(d).data.forEach((dot, i) => {
          const mark = set.data[i];
          if (mark.low == null || mark.high == null) return;
          const from = scale.getPixelForValue(mark.low), to = scale.getPixelForValue(mark.high);
          ctx.strokeStyle = Array.isArray(set.borderColor) ? set.borderColor[i] : set.borderColor;
          ctx.globalAlpha = 0.45;
          ctx.lineWidth = 6;
          ctx.lineCap = 'round';
          ctx.beginPath();
          if (flat) { ctx.moveTo(from, dot.y); ctx.lineTo(to, dot.y); }
          else { ctx.moveTo(dot.x, from); ctx.lineTo(dot.x, to); }
          ctx.stroke();
        });
      });
      ctx.restore();
    },
  };

  const numberAxis = (data) => ({
    type: data.logarithmic ? 'logarithmic' : 'linear',
    beginAtZero: !data.logarithmic,
    grid: {color: style('--line'), drawBorder: false},
    ticks: {color: style('--quiet'), maxTicksLimit: 6, maxRotation: 0, callback: (v) =>
        data.logarithmic && !Number.isInteger(Math.log10(v) + 1e-9 - 1e-9) ? '' : short(v)},
  });

  // Includes the whiskers, which Chart.js does not know of.
  const fit = (axis, data, marks) => {
    const ends = marks.flatMap((m) => [m.value, m.low, m.high]).filter((v) => v != null);
    if (data.logarithmic) {
      axis.min = 10 ** Math.floor(Math.log10(Math.min(...ends)));
      axis.max = 10 ** Math.ceil(Math.log10(Math.max(...ends)) + 1e-9);
    } else {
      axis.suggestedMin = Math.min(...ends);
      axis.suggestedMax = Math.max(...ends);
    }
    return axis;
  };

  const words = (data, name, mark) => name + ': ' + short(mark.value) + data.suffix +
      (mark.low == null ? '' : ' (' + short(mark.low) + ' to ' + short(mark.high) + ')');

  const common = () => ({
    responsive: true, maintainAspectRatio: false, animation: false,
    plugins: {legend: {display: false}, tooltip: {displayColors: false}},
  });
  const legend = () => ({display: true, position: 'top', align: 'start',
    labels: {usePointStyle: true, color: style('--ink'), boxHeight: 7}});
  const names = (labels, first, last) => ({type: 'linear', min: first, max: last, grid: {display: false, drawBorder: false},
    afterBuildTicks: (axis) => { axis.ticks = labels.map((_, i) => ({value: i})); },
    ticks: {autoSkip: false, color: style('--ink'), callback: (v) => labels[v] ?? ''}});

  // One condition: methods under each other, where their names can be read.
  const methodsInRows = (data) => {
    const marks = data.methods.map((m) => m.marks[0]);
    const options = common();
    options.indexAxis = 'y';
    options.scales = {
      x: fit(numberAxis(data), data, marks),
      y: {...names(data.methods.map((m) => m.name), -0.6, marks.length - 0.4), reverse: true},
    };
    options.plugins.tooltip.callbacks = {label: (c) => words(data, data.methods[c.raw.y].name, c.raw)};
    const colours = marks.map((_, i) => colour(i));
    return {type: 'scatter', options, plugins: [whiskers], data: {datasets: [{
      data: marks.map((m, i) => ({x: m.value, y: i, ...m})),
      pointStyle: marks.map((_, i) => shape(i)),
      backgroundColor: colours, borderColor: colours, radius: 6, hoverRadius: 8, borderWidth: 2}]}};
  };

  // Several conditions: along the axis, methods side by side in each.
  const conditionsInColumns = (data) => {
    const n = data.methods.length;
    const options = common();
    options.scales = {
      x: names(data.groups, -0.5, data.groups.length - 0.5),
      y: fit(numberAxis(data), data, data.methods.flatMap((m) => m.marks)),
    };
    options.scales.x.title = {display: data.groupLabel !== '', text: data.groupLabel, color: style('--quiet')};
    options.plugins.legend = legend();
    options.plugins.tooltip.callbacks = {label: (c) => words(data, c.dataset.label, c.raw)};
    return {type: 'scatter', options, plugins: [whiskers], data: {datasets: data.methods.map((method, i) => ({
      label: method.name, pointStyle: shape(i), radius: 5, hoverRadius: 7, borderWidth: 2,
      borderColor: colour(i), backgroundColor: colour(i),
      data: method.marks.map((m, g) => ({x: g + (i - (n - 1) / 2) * Math.min(0.16, 0.7 / n), y: m.value, ...m}))}))}};
  };

  const curves = (data) => {
    const options = common();
    const all = data.methods.flatMap((m) => m.values.map((value) => ({value})));
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
      const config = data.kind === 'curves' ? curves(data) : data.groups.length === 1 ? methodsInRows(data) : conditionsInColumns(data);
      charts.push(new Chart(canvas, config));
    });
  };
  draw();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);

  const video = document.querySelector('video');
  if (video && matchMedia('(prefers-reduced-motion: reduce)').matches) { video.autoplay = false; video.pause(); }
})();
