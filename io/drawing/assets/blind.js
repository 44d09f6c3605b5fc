// Shows pairs of films one by one, takes one answer for each, and saves all answers as a file.
const blind = document.querySelector('.blind');
const pairs = [...blind.querySelectorAll('.pair')];
const preferred = pairs.map(() => '');
const seen = new Set();
const [rater, place, save, back] = ['rater', 'place', 'save', 'back'].map((id) => document.getElementById(id));
const buttons = [...blind.querySelectorAll('[data-answer]')];
let at = 0, saved = true;

const show = (next) => {
  at = Math.min(Math.max(next, 0), pairs.length);
  pairs.forEach((pair, i) => {
    pair.hidden = i !== at;
    const film = pair.querySelector('video');
    film.pause();
    if (i === at) {
      film.currentTime = 0;
      film.play().catch(() => {});
    }
  });
  const answered = preferred.filter(Boolean).length;
  place.textContent = at < pairs.length ? `Pair ${at + 1} of ${pairs.length}` : `${answered} of ${pairs.length} pairs are answered. Save your answers.`;
  for (const button of buttons) {
    button.disabled = at === pairs.length || !seen.has(at);
    button.setAttribute('aria-pressed', preferred[at] === button.dataset.answer);
  }
  back.disabled = at === 0;
  save.disabled = !answered || !rater.value.trim();
};

const answer = (side) => {
  if (at === pairs.length || !seen.has(at)) return;
  preferred[at] = side;
  saved = false;
  show(at + 1);
};

pairs.forEach((pair, i) => {
  const film = pair.querySelector('video');
  film.onended = () => {
    seen.add(i);
    if (i === at) buttons.forEach((button) => { button.disabled = false; });
    film.play().catch(() => {});
  };
});
buttons.forEach((button) => { button.onclick = () => answer(button.dataset.answer); });
back.onclick = () => show(at - 1);
rater.oninput = () => { save.disabled = !preferred.some(Boolean) || !rater.value.trim(); };
save.onclick = () => {
  const answers = {format: 'etude-blind-answers', version: 1, page: blind.dataset.page, rater: rater.value.trim(), preferred};
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([JSON.stringify(answers) + '\n'], {type: 'application/json'}));
  link.download = `answers-${blind.dataset.page}-${answers.rater.replace(/[^\w.-]+/g, '_')}.json`;
  link.click();
  saved = true;
  setTimeout(() => URL.revokeObjectURL(link.href), 1e4);
};
document.onkeydown = (event) => {
  const side = {ArrowLeft: 'left', ArrowDown: 'same', ArrowRight: 'right'}[event.key];
  if (!side || event.target === rater || event.target.tagName === 'VIDEO') return;
  if (event.repeat || event.altKey || event.ctrlKey || event.metaKey) return;  // shortcuts are not answers: Alt+Left leaves the page
  event.preventDefault();
  answer(side);
};
addEventListener('beforeunload', (event) => { if (!saved) event.preventDefault(); });
show(0);
