
// The start, and the order of the views.

function addViews() {
  addOverview();
  addMatrix();
  addChecks();
  addCheckView();
  addImages();
  addBars();
  addSpeed();
  addRayCosts();
  addVerdictCost();
  addVarianceRatios();
  addCalibration();
  addStability();
  addCauses();
  addFigures();
  addHistory();
  addDuets();
  addSearch();
}

async function start() {
  data = await readData();
  addViews();
  startViews();
  // Canvases keep the colours that they were drawn in.
  for (const query of ['(prefers-color-scheme: dark)', 'print']) matchMedia(query).addEventListener('change', redrawCharts);
  startPaper();
}

start().catch((error) => {
  document.querySelector('main').append(element('p', {className: 'notice', role: 'alert'},
    `This page cannot be shown: ${error}. It needs a browser of 2023 or later.`));
  throw error;
});
