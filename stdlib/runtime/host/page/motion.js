// SPDX-License-Identifier: Apache-2.0
// Axes and cams, where the program has some: position and velocity of each axis over the last seconds, and the table of
// each cam as a curve. An axis is known by its members, as everywhere.
'use strict';

const motion = {axes: [], cams: []};
const kSeconds = 20;
// What is shown of an axis, where it has it: the members of AXIS_REF of SoftMotion and of TwinCAT.
const kPositions = ['fActPosition', 'NcToPlc.ActPos'], kVelocities = ['fActVelocity', 'NcToPlc.ActVelo'];
const kSetPositions = ['fSetPosition', 'NcToPlc.SetPos'], kStates = ['nAxisState', 'NcToPlc.StateDWord'];

function memberOf(symbol, names) {
  const found = names.map(name => symbolOf(symbol.path + '.' + name)).find(member => member);
  return found ? found.path : undefined;
}

function axisOf(symbol) {
  const position = memberOf(symbol, kPositions), velocity = memberOf(symbol, kVelocities);
  if (!position || !velocity) return null;
  const text = make('span', {class: 'quiet'});
  const canvas = make('canvas', {role: 'img', 'aria-label': `Position and velocity of ${symbol.path}`});
  const plot = make('div', {class: 'plot'}, make('h3', {}, symbol.path, text), canvas);
  return {name: symbol.path, position, velocity, set: memberOf(symbol, kSetPositions), state: memberOf(symbol, kStates),
    plot, canvas, text, samples: []};
}

function paintAxis(axis) {
  const {context, width, height, style} = contextOf(axis.canvas);
  const last_ms = program.time_ms, first_ms = last_ms - kSeconds * 1000;
  const curve = (key, colour) => {
    const [low, high] = limitsOf(axis.samples.map(sample => sample[key]), 0, axis.samples.length);
    context.strokeStyle = style.getPropertyValue(colour);
    context.lineWidth = 1.5;
    context.beginPath();
    for (const sample of axis.samples)
      context.lineTo((sample.time_ms - first_ms) / (kSeconds * 1000) * width, height - 6 - (sample[key] - low) / (high - low) * (height - 12));
    context.stroke();
  };
  curve('velocity', '--lane2');
  curve('position', '--lane1');
  const value = path => path ? program.values.get(path) ?? '' : '';
  axis.text.textContent = `position ${value(axis.position)}` + (axis.set ? ` (set ${value(axis.set)})` : '') +
    `, velocity ${value(axis.velocity)}` + (axis.state ? `, ${value(axis.state)}` : '');
}

function paintMotion() {
  for (const axis of motion.axes) {
    const sample = {time_ms: program.time_ms, position: numberOf(program.values.get(axis.position)), velocity: numberOf(program.values.get(axis.velocity))};
    axis.samples.push(sample);
    while (axis.samples[0].time_ms < sample.time_ms - kSeconds * 1000 || axis.samples[0].time_ms > sample.time_ms) axis.samples.shift();
    paintAxis(axis);
  }
}

// A cam's table is an array of points: master position, slave position, and its first and second derivative.
async function readCam(name, path) {
  const points = (tree.children.get(path) || []).slice(0, 2000);
  const members = ['dX', 'dY', 'dV', 'dA'];
  const paths = points.flatMap(point => members.map(member => `${point.path}.${member}`));
  const {values} = await ask('/api/values', {paths});
  let rows = points.map(point => members.map(member => numberOf(values[`${point.path}.${member}`])));
  const end = rows.findIndex((row, i) => i > 0 && row[0] <= rows[i - 1][0]);  // what follows is not used
  if (end > 0) rows = rows.slice(0, end);
  if (rows.length < 2) return;
  const curve = rows.slice(1).flatMap((row, i) => segmentOf(rows[i], row));
  const canvas = make('canvas', {role: 'img', 'aria-label': `The cam ${name}`});
  const [low, high] = limitsOf(curve.map(point => point[1]), 0, curve.length);
  const range = `master ${shortNumber(rows[0][0])} to ${shortNumber(rows[rows.length - 1][0])}, slave ${shortNumber(low)} to ${shortNumber(high)}, ${rows.length} points`;
  byId('cams').append(make('div', {class: 'plot'}, make('h3', {}, name, make('span', {class: 'quiet'}, range)), canvas));
  motion.cams.push({curve, low, high, canvas});
}

// Between two points the cam is the polynomial of degree 5 that has their positions and derivatives.
function segmentOf([x0, y0, v0, a0], [x1, y1, v1, a1]) {
  const kSteps = 24, h = x1 - x0, points = [];
  const p0 = y0, p1 = v0 * h, p2 = a0 * h * h / 2;
  const d = y1 - p0 - p1 - p2, s = v1 * h - p1 - 2 * p2, c = a1 * h * h / 2 - p2;
  for (let i = 0; i <= kSteps; ++i) {
    const u = i / kSteps;
    points.push([x0 + u * h, p0 + u * (p1 + u * (p2 + u * (10 * d - 4 * s + c + u * (-15 * d + 7 * s - 2 * c + u * (6 * d - 3 * s + c)))))]);
  }
  return points;
}

function paintCam({curve, low, high, canvas}) {
  const {context, width, height, style} = contextOf(canvas);
  const first = curve[0][0], last = curve[curve.length - 1][0];
  context.strokeStyle = style.getPropertyValue('--lane1');
  context.lineWidth = 1.5;
  context.beginPath();
  for (const [x, y] of curve) context.lineTo((x - first) / (last - first) * width, height - 6 - (y - low) / (high - low) * (height - 12));
  context.stroke();
}

views.push({
  tab: 'motion',
  paths: () => motion.axes.flatMap(axis => [axis.position, axis.velocity, axis.set, axis.state].filter(path => path)),
  onValues: paintMotion,
  onShow: () => motion.cams.forEach(paintCam),
});

async function startMotion() {
  const symbols = [...program.symbols.values()];
  motion.axes = symbols.filter(symbol => symbol.kind === 'record').map(axisOf).filter(axis => axis);
  byId('axes').replaceChildren(...motion.axes.map(axis => axis.plot));
  for (const symbol of symbols)
    if (symbol.kind === 'array' && symbolOf(((tree.children.get(symbol.path) || [])[0] || {path: ''}).path + '.dX'))
      await readCam(symbol.path.replace(/_A$/, ''), symbol.path);
  byId('tab-motion').hidden = motion.axes.length + motion.cams.length === 0;
}
