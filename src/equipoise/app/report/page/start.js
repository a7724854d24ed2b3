/**
 * The report's beginning: each figure with data becomes a chart, and follows the theme. Without
 * scripts, or on paper, the drawings stand. `window.equipoiseReport` is for the tests.
 */

import { ChartFigure } from "./chart_figure.js";
import { reported } from "./embedded.js";
import { followTheme } from "./theme.js";

const figures = reported("chart").map(({ place, block }) => new ChartFigure(place, block));
followTheme((colours) => figures.forEach((figure) => figure.recolour(colours)));
window.equipoiseReport = { figures, replays: [] };
document.documentElement.dataset.live = "charts";
