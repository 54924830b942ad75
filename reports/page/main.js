
// The order of the views.

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
addSearch();
startViews();
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redrawCharts);
