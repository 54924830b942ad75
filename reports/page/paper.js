
// On paper stand all views one after the other, in light colours, with what is otherwise made as one comes to it.

const onPaper = () => document.documentElement.classList.contains('paper');

function layOutForPaper() {
  if (onPaper()) return;
  document.documentElement.classList.add('paper');  // the width of a sheet, so that plots are drawn in it
  const printed = (view) => view.group !== null || view === shownView;
  for (const view of views.filter(printed)) if (!view.section) makeView(view);
  showOnly(printed);
  for (const {node, fill} of [...waiting]) if (node.isConnected) fill();
  redrawCharts();
}

function leavePaper() {
  document.documentElement.classList.remove('paper');
  showOnly((view) => view === shownView);
  redrawCharts();
  scrollTo(0, shownView.scroll);
}

/** A browser does not wait for pictures when it prints, so they are unpacked while it has nothing to do. */
async function unpackPictures() {
  for (const image of data.images) {
    await new Promise((resume) => requestIdleCallback(resume));
    await floatsOf(image);
  }
}

function startPaper() {
  addEventListener('beforeprint', () => {
    shownView.scroll = scrollY;
    layOutForPaper();
  });
  addEventListener('afterprint', leavePaper);
  unpackPictures();
}
