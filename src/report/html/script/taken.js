'use strict';
// The frame of `linkproof watch`: pages replace each other here, so that the browser reads style and script once.

let current = null;
let view = null;

/** Replaces all but the sections below the picture, which stay as they are, but pale. */
function takePicture(next) {
  for (const what of ['header', '#motion', '#data']) document.querySelector(what).replaceWith(next.querySelector(what));
  for (const own of document.querySelectorAll('main > section:not(#motion)')) own.classList.add('outdated');
}

function takeAll(next) {
  const [style, ours] = [next, document].map((own) => own.querySelector('head > style'));
  if (style.textContent !== ours.textContent) ours.replaceWith(style);
  document.body.replaceWith(next.body);
}

/** Shows a page; of its sections only the picture if `isPicture`, until the next page. */
window.linkproofTake = (text, isPicture) => {
  const next = new DOMParser().parseFromString(text, 'text/html');
  if (current !== null) view = current.end();
  const [hadData, hasData] = [document, next].map((own) => own.getElementById('data') !== null);
  const [top, isPart] = [window.scrollY, isPicture && hadData && hasData];
  if (isPart) takePicture(next);
  else takeAll(next);
  current = hasData ? run(view) : null;
  if (current !== null && view !== null) current.resume(view);
  if (!isPart) window.scrollTo(0, top);
};
