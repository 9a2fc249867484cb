// SPDX-License-Identifier: Apache-2.0
// The model of the counter unit: see rung/hsio.h. Time passes from event to event: edges of inputs and signals, ticks
// of timing counters, ends of output pulses and samples. What an event causes happens at its time.
#include "rung/hsio.h"

#include <string.h>

namespace {

constexpr int64_t kNever = INT64_MAX;
constexpr int kTriggers = 4;                                    // counters 0 to 3 have a trigger and a Z input
constexpr uint8_t kCountLines[] = {0, 2, 8, 10, 4, 6, 12, 14};  // A of a counter, B follows (AX 4.2.1)
constexpr uint8_t kTriggerLine = 8, kZLine = 4;                 // of counter 0
enum Function { kCommon, kCount, kTrigger };                    // of an input
enum TriggerUse { kNoUse, kSoftware, kExternal, kOnCompare, kLatch };
enum Mode { kSingle, kQuadrature, kTiming, kDirection };
constexpr uint8_t kCompareOutput = 2;
constexpr uint32_t kFirstCompare = 8, kFirstProbe = 16;

int64_t least(int64_t a, int64_t b) { return a < b ? a : b; }

void interrupt(rung_hsio_model& model, uint32_t source) {
  if (!model.interrupts_on || (model.interrupt_enable >> source & 1) == 0) return;
  ++model.interrupt_count[source];
  model.raised |= 1u << source;
}

// `place`: of the source in INTERRUPT_EDGES, which has no comparisons.
void edgeInterrupt(rung_hsio_model& model, uint32_t source, uint32_t place, bool rising) {
  const uint64_t mode = model.interrupt_edges >> (2 * place) & 3;
  if (mode == 2 || (mode == 0) == rising) interrupt(model, source);
}

void setOutput(rung_hsio_model& model, int number, bool level) {
  rung_hsio_output& output = model.outputs[number];
  if ((output.level != 0) == level) return;
  output.level = level ? 1 : 0;
  (level ? output.rise : output.fall) = model.now;
  output.rises += level ? 1 : 0;
}

void compareOutput(rung_hsio_model& model, const rung_hsio_counter& counter, bool level) {
  if (counter.output >= 0 && model.outputs[counter.output].function == kCompareOutput)
    setOutput(model, counter.output, level);
}

void hit(rung_hsio_model& model, uint32_t number, int32_t point) {
  rung_hsio_counter& counter = model.counters[number];
  ++counter.hits;
  counter.last_point = point;
  counter.hit_time = model.now;
  counter.hit_count = counter.count;
  if (counter.hold > 0 || counter.hold_pulses > 0) {
    compareOutput(model, counter, true);
    if (counter.hold > 0 && counter.output >= 0) model.outputs[counter.output].off_at = model.now + counter.hold;
  }
  for (uint32_t i = 0; i < RUNG_HSIO_COUNTERS; ++i) {
    const bool by_point = (model.interrupt_points >> i & 1) != 0;
    if (by_point ? model.interrupt_counter == number && point == static_cast<int32_t>(i) : i == number)
      interrupt(model, kFirstCompare + i);
  }
}

// A value of a comparison: one of the list, or of equal steps.
int32_t pointOf(const rung_hsio_counter& counter, int32_t number) {
  if (counter.distance == 0) return number < RUNG_HSIO_POINTS ? counter.point[number] : INT32_MIN;
  const int64_t half = 1 << 19;
  return static_cast<int32_t>((counter.first + number * counter.distance + half) >> 20);
}

// The comparison after a change of the count. Returns true when a value was reached.
bool compare(rung_hsio_model& model, uint32_t number) {
  rung_hsio_counter& counter = model.counters[number];
  if (counter.compare == RUNG_HSIO_COMPARE_OFF) return false;
  const auto count = static_cast<int32_t>(counter.count);
  if (counter.hold_pulses > 0 && counter.hits > 0) {
    const int64_t moved = counter.count - counter.hit_count;
    if (moved >= counter.hold_pulses || -moved >= counter.hold_pulses) compareOutput(model, counter, false);
  }
  int32_t reached = -1;
  if (counter.compare == RUNG_HSIO_COMPARE_ORDER) {
    if (counter.next_point < counter.points && pointOf(counter, counter.next_point) == count)
      reached = counter.next_point++;
  } else if (counter.compare == RUNG_HSIO_COMPARE_ANY || counter.hits == 0) {
    for (int32_t i = 0; i < counter.points && i < RUNG_HSIO_POINTS && reached < 0; ++i)
      if (counter.point[i] == count) reached = i;
  }
  counter.equal = reached >= 0 ? 1 : 0;
  if (reached >= 0) hit(model, number, reached);
  if (counter.hold == 0 && counter.hold_pulses == 0) compareOutput(model, counter, reached >= 0);
  return reached >= 0;
}

void setCount(rung_hsio_model& model, uint32_t number, int64_t count) {
  rung_hsio_counter& counter = model.counters[number];
  counter.count = count;
  counter.has_z = 0;
  compare(model, number);
}

void preset(rung_hsio_model& model, uint32_t number) {
  ++model.counters[number].presets;
  setCount(model, number, model.counters[number].preset);
}

void step(rung_hsio_model& model, uint32_t number, bool down) {
  rung_hsio_counter& counter = model.counters[number];
  if (!counter.enable) return;
  counter.down = down ? 1 : 0;
  counter.has_counted = 1;
  ++counter.pulses;
  counter.net += down ? -1 : 1;
  counter.last_pulse = model.now;
  if (counter.linear && (down ? counter.count <= counter.minimum : counter.count >= counter.maximum)) return;
  counter.count += down ? -1 : 1;
  if (!compare(model, number) || counter.trigger_use != kOnCompare) return;
  ++counter.presets;
  counter.count = counter.preset;  // not compared again: the preset may be one of the values
  counter.has_z = 0;
}

// At Z the count is the nearest multiple of a turn, from the first Z on. AX A.3.11.
void zPulse(rung_hsio_model& model, uint32_t number) {
  rung_hsio_counter& counter = model.counters[number];
  if ((counter.z_use & 1) != 0) return setCount(model, number, 0);
  if ((counter.z_use & 2) == 0 || !counter.has_counted || counter.ratio <= 0) return;
  if (!counter.has_z) {
    counter.has_z = 1;
    counter.z_count = counter.count;
    return;
  }
  const int64_t moved = counter.count - counter.z_count, half = counter.ratio / 2;
  const int64_t turns = (moved + (moved < 0 ? -half : half)) / counter.ratio;
  const int64_t exact = counter.z_count + turns * counter.ratio;
  if (exact == counter.count) return;
  counter.count = exact;
  compare(model, number);
}

void probe(rung_hsio_probe& probe, int64_t count, bool rising) {
  (rising ? probe.rise : probe.fall) = count;
  ++(rising ? probe.rises : probe.falls);
}

bool isLine(const rung_hsio_model& model, int8_t chosen, uint32_t line, uint32_t by_function, Function function) {
  if (chosen >= 0) return static_cast<uint32_t>(chosen) == line;
  return line == by_function && model.lines[line].function == function;
}

bool levelOfB(const rung_hsio_model& model, uint32_t number) {
  const int8_t chosen = model.counters[number].line_b;
  return model.lines[chosen >= 0 ? chosen : kCountLines[number] + 1].level != 0;
}
bool levelOfA(const rung_hsio_model& model, uint32_t number) {
  const int8_t chosen = model.counters[number].line_a;
  return model.lines[chosen >= 0 ? chosen : kCountLines[number]].level != 0;
}

// An edge of A, or of B.
void count(rung_hsio_model& model, uint32_t number, bool is_a, bool rising) {
  const rung_hsio_counter& counter = model.counters[number];
  switch (counter.mode) {
    case kSingle:
      if (is_a && rising) step(model, number, counter.reverse != 0);
      break;
    case kDirection:
      if (is_a && rising) step(model, number, !levelOfB(model, number));
      break;
    case kQuadrature:
      // A leads B: up. Not multiplied, a period of A counts where B is low, so that a jitter of A cancels itself.
      if (counter.quadruple)
        step(model, number, is_a ? rising == levelOfB(model, number) : rising != levelOfA(model, number));
      else if (is_a && !levelOfB(model, number))
        step(model, number, !rising);
      break;
    default: break;
  }
}

void edge(rung_hsio_model& model, uint32_t number, bool rising) {
  rung_hsio_line& line = model.lines[number];
  const int64_t lasted = line.since < 0 ? 0 : model.now - line.since;
  line.level = rising ? 1 : 0;
  (rising ? line.low : line.high) = lasted;
  ++(rising ? line.rises : line.falls);
  line.since = model.now;
  for (uint32_t i = 0; i < RUNG_HSIO_COUNTERS; ++i) {
    rung_hsio_counter& counter = model.counters[i];
    if (isLine(model, counter.line_a, number, kCountLines[i], kCount)) count(model, i, true, rising);
    if (isLine(model, counter.line_b, number, kCountLines[i] + 1u, kCount)) count(model, i, false, rising);
    if (i < kTriggers && rising && isLine(model, -1, number, kZLine + i, kTrigger)) zPulse(model, i);
    for (int p = 1; p < 3; ++p)
      if (counter.probe[p].line == static_cast<int>(number)) probe(counter.probe[p], counter.count, rising);
    const uint32_t by_function = i < kTriggers ? kTriggerLine + i : uint32_t{RUNG_HSIO_LINES};
    if (!isLine(model, counter.probe[0].line, number, by_function, kTrigger)) continue;
    if (counter.trigger_use == kLatch) probe(counter.probe[0], counter.count, rising);
    if (counter.trigger_use == kExternal && rising) preset(model, i);
    if (i < kTriggers) edgeInterrupt(model, kFirstProbe + i, 8 + i, rising);
  }
  if (number < 8) edgeInterrupt(model, number, number, rising);
}

void raw(rung_hsio_model& model, uint32_t number, bool level) {
  rung_hsio_line& line = model.lines[number];
  if ((line.raw != 0) == level) return;
  line.raw = level ? 1 : 0;
  line.raw_since = model.now;
  if ((model.filter == 0 || number >= RUNG_HSIO_INPUTS) && line.level != line.raw) edge(model, number, level);
}

// When a line that is not yet stable becomes so.
int64_t stableAt(const rung_hsio_model& model, const rung_hsio_line& line) {
  return line.raw == line.level ? kNever : line.raw_since + model.filter;
}

void schedule(rung_hsio_signal& signal) {
  const int64_t period = signal.edges / 2;
  const bool ended = signal.period <= 0 || (signal.count > 0 && period >= signal.count);
  const int64_t high = signal.high > 0 && signal.high < signal.period ? signal.high : signal.period / 2;
  signal.next =
      ended ? kNever : signal.start + signal.delay + period * signal.period + ((signal.edges & 1) != 0 ? high : 0);
}

bool ticks(const rung_hsio_counter& counter) { return counter.enable && counter.mode == kTiming && counter.tick > 0; }

int64_t nextEvent(const rung_hsio_model& model) {
  int64_t next = kNever;
  for (const rung_hsio_line& line : model.lines) next = least(next, least(line.signal.next, stableAt(model, line)));
  for (const rung_hsio_counter& counter : model.counters) {
    if (ticks(counter)) next = least(next, counter.tick_from + counter.tick);
    next = least(next, counter.sample_end);
  }
  for (const rung_hsio_output& output : model.outputs) next = least(next, output.off_at);
  return next;
}

// All events of `model.now`. A sample ends before, so that a pulse at its end does not count; time is counted before
// edges, so that a latch has the time of its edge.
void happen(rung_hsio_model& model) {
  for (rung_hsio_counter& counter : model.counters) {
    if (counter.sample_end > model.now) continue;
    counter.sampled = counter.pulses - counter.sample_from;
    counter.sample_end = kNever;
  }
  for (int i = 0; i < RUNG_HSIO_OUTPUTS; ++i) {
    if (model.outputs[i].off_at > model.now) continue;
    model.outputs[i].off_at = kNever;
    setOutput(model, i, false);
  }
  for (uint32_t i = 0; i < RUNG_HSIO_COUNTERS; ++i) {
    rung_hsio_counter& counter = model.counters[i];
    if (!ticks(counter) || counter.tick_from + counter.tick > model.now) continue;
    counter.tick_from += counter.tick;
    step(model, i, counter.reverse != 0);
  }
  for (uint32_t i = 0; i < RUNG_HSIO_LINES; ++i) {
    rung_hsio_line& line = model.lines[i];
    if (stableAt(model, line) <= model.now) edge(model, i, line.raw != 0);
    if (line.signal.next > model.now) continue;
    const bool rising = (line.signal.edges++ & 1) == 0;
    schedule(line.signal);
    raw(model, i, rising);
  }
}

bool pwmLevel(const rung_hsio_output& output, int64_t now) {
  return output.period > 0 && (now - output.start) % output.period < output.width;
}

}  // namespace

extern "C" {

void rung_hsio_reset(rung_hsio_model* model, bool has_signals) {
  memset(model, 0, sizeof *model);
  model->has_signals = has_signals ? 1 : 0;
  for (rung_hsio_line& line : model->lines) {
    line.since = -1;
    line.signal.next = kNever;
  }
  for (rung_hsio_counter& counter : model->counters) {
    counter.line_a = counter.line_b = counter.output = -1;
    for (rung_hsio_probe& one : counter.probe) one.line = -1;
    counter.sample_end = kNever;
    counter.sampled = counter.last_point = -1;
    counter.hit_time = counter.last_pulse = -1;
  }
  for (rung_hsio_output& output : model->outputs) {
    output.off_at = kNever;
    output.rise = output.fall = -1;
  }
}

void rung_hsio_advance(rung_hsio_model* model, int64_t until) {
  while (model->raised == 0) {
    const int64_t next = nextEvent(*model);
    if (next > until) break;
    if (next > model->now) model->now = next;
    happen(*model);
  }
  if (model->raised == 0 && until > model->now) model->now = until;
}

uint32_t rung_hsio_take_interrupts(rung_hsio_model* model) {
  const uint32_t raised = model->raised;
  model->raised = 0;
  return raised;
}

const char* rung_hsio_event(uint32_t interrupt) {
  static const char* const names[RUNG_HSIO_INTERRUPTS] = {
      "in0Interrupt",  "in1Interrupt",  "in2Interrupt",  "in3Interrupt",  "in4Interrupt",
      "in5Interrupt",  "in6Interrupt",  "in7Interrupt",  "cmp0Interrupt", "cmp1Interrupt",
      "cmp2Interrupt", "cmp3Interrupt", "cmp4Interrupt", "cmp5Interrupt", "cmp6Interrupt",
      "cmp7Interrupt", "prb0Interrupt", "prb1Interrupt", "prb2Interrupt", "prb3Interrupt"};
  return interrupt < RUNG_HSIO_INTERRUPTS ? names[interrupt] : "";
}

void rung_hsio_edge(rung_hsio_model* model, uint32_t line, bool level) {
  if (line < RUNG_HSIO_LINES) raw(*model, line, level);
}

}  // extern "C"

namespace {

int64_t readLine(const rung_hsio_line& line, uint32_t item) {
  switch (item) {
    case RUNG_HSIO_LEVEL: return line.level;
    case RUNG_HSIO_INPUT_FUNCTION: return line.function;
    case RUNG_HSIO_HIGH: return line.high;
    case RUNG_HSIO_LOW: return line.low;
    case RUNG_HSIO_RISES: return line.rises;
    case RUNG_HSIO_FALLS: return line.falls;
    case RUNG_HSIO_SIGNAL_PERIOD: return line.signal.period;
    case RUNG_HSIO_SIGNAL_HIGH: return line.signal.high;
    case RUNG_HSIO_SIGNAL_DELAY: return line.signal.delay;
    case RUNG_HSIO_SIGNAL_COUNT: return line.signal.count;
    default: return 0;
  }
}

bool writeLine(rung_hsio_model& model, uint32_t number, uint32_t item, int64_t value) {
  rung_hsio_line& line = model.lines[number];
  if (item == RUNG_HSIO_INPUT_FUNCTION) {
    if (number >= RUNG_HSIO_INPUTS || value < 0 || value > 4) return false;
    line.function = static_cast<uint8_t>(value);
    return true;
  }
  if (!model.has_signals || value < 0) return false;
  switch (item) {
    case RUNG_HSIO_LEVEL: raw(model, number, value != 0); return true;
    case RUNG_HSIO_SIGNAL_HIGH: line.signal.high = value; break;  // these end a signal until PERIOD is written
    case RUNG_HSIO_SIGNAL_DELAY: line.signal.delay = value; break;
    case RUNG_HSIO_SIGNAL_COUNT: line.signal.count = value; break;
    case RUNG_HSIO_SIGNAL_PERIOD:
      line.signal.period = value;
      line.signal.start = model.now;
      line.signal.edges = 0;
      if (value > 0) raw(model, number, false);
      schedule(line.signal);
      return true;
    default: return false;
  }
  line.signal.next = kNever;
  return true;
}

int64_t readCounter(const rung_hsio_counter& counter, uint32_t item) {
  switch (item) {
    case RUNG_HSIO_ENABLE: return counter.enable;
    case RUNG_HSIO_MODE: return counter.mode;
    case RUNG_HSIO_QUADRUPLE: return counter.quadruple;
    case RUNG_HSIO_TICK: return counter.tick;
    case RUNG_HSIO_REVERSE: return counter.reverse;
    case RUNG_HSIO_LINEAR: return counter.linear;
    case RUNG_HSIO_MAXIMUM: return counter.maximum;
    case RUNG_HSIO_MINIMUM: return counter.minimum;
    case RUNG_HSIO_LINE_A: return counter.line_a;
    case RUNG_HSIO_LINE_B: return counter.line_b;
    case RUNG_HSIO_LINE_TRIGGER: return counter.probe[0].line;
    case RUNG_HSIO_TRIGGER_USE: return counter.trigger_use;
    case RUNG_HSIO_PRESET: return counter.preset;
    case RUNG_HSIO_Z_USE: return counter.z_use;
    case RUNG_HSIO_RATIO: return counter.ratio;
    case RUNG_HSIO_COUNT: return counter.count;
    case RUNG_HSIO_PULSES: return counter.pulses;
    case RUNG_HSIO_DOWN: return counter.down;
    case RUNG_HSIO_PRESETS: return counter.presets;
    case RUNG_HSIO_LATCH_RISE: return counter.probe[0].rise;
    case RUNG_HSIO_LATCH_FALL: return counter.probe[0].fall;
    case RUNG_HSIO_LATCH_RISES: return counter.probe[0].rises;
    case RUNG_HSIO_LATCH_FALLS: return counter.probe[0].falls;
    case RUNG_HSIO_SAMPLED: return counter.sampled;
    case RUNG_HSIO_BROKEN: return counter.broken;
    case RUNG_HSIO_LAST_PULSE: return counter.last_pulse;
    case RUNG_HSIO_NET: return counter.net;
    case RUNG_HSIO_PROBE_LINE_1: return counter.probe[1].line;
    case RUNG_HSIO_PROBE_RISE_1: return counter.probe[1].rise;
    case RUNG_HSIO_PROBE_FALL_1: return counter.probe[1].fall;
    case RUNG_HSIO_PROBE_RISES_1: return counter.probe[1].rises;
    case RUNG_HSIO_PROBE_FALLS_1: return counter.probe[1].falls;
    case RUNG_HSIO_PROBE_LINE_2: return counter.probe[2].line;
    case RUNG_HSIO_PROBE_RISE_2: return counter.probe[2].rise;
    case RUNG_HSIO_PROBE_FALL_2: return counter.probe[2].fall;
    case RUNG_HSIO_PROBE_RISES_2: return counter.probe[2].rises;
    case RUNG_HSIO_PROBE_FALLS_2: return counter.probe[2].falls;
    case RUNG_HSIO_COMPARE: return counter.compare;
    case RUNG_HSIO_COMPARE_COUNT: return counter.points;
    case RUNG_HSIO_COMPARE_OUTPUT: return counter.output;
    case RUNG_HSIO_COMPARE_HOLD: return counter.hold;
    case RUNG_HSIO_COMPARE_HOLD_PULSES: return counter.hold_pulses;
    case RUNG_HSIO_COMPARE_HITS: return counter.hits;
    case RUNG_HSIO_COMPARE_LAST: return counter.last_point;
    case RUNG_HSIO_COMPARE_TIME: return counter.hit_time;
    case RUNG_HSIO_COMPARE_EQUAL: return counter.equal;
    case RUNG_HSIO_COMPARE_START: return counter.first;
    case RUNG_HSIO_COMPARE_STEP: return counter.distance;
    default: return item >= RUNG_HSIO_COMPARE_VALUE ? counter.point[item - RUNG_HSIO_COMPARE_VALUE] : 0;
  }
}

bool isLineOrNone(int64_t value) { return value >= -1 && value < RUNG_HSIO_LINES; }

bool startCompare(rung_hsio_model& model, uint32_t number, int64_t value) {
  rung_hsio_counter& counter = model.counters[number];
  if (value < RUNG_HSIO_COMPARE_OFF || value > RUNG_HSIO_COMPARE_ONCE) return false;
  if (counter.compare != RUNG_HSIO_COMPARE_OFF) {
    compareOutput(model, counter, false);
    if (counter.output >= 0) model.outputs[counter.output].off_at = kNever;
  }
  counter.compare = static_cast<uint8_t>(value);
  counter.next_point = counter.hits = 0;
  counter.last_point = -1;
  counter.equal = 0;
  compare(model, number);
  return true;
}

// A register of the comparison of the count with points.
bool writeCompare(rung_hsio_model& model, uint32_t number, uint32_t item, int64_t value) {
  rung_hsio_counter& counter = model.counters[number];
  switch (item) {
    case RUNG_HSIO_COMPARE: return startCompare(model, number, value);
    case RUNG_HSIO_COMPARE_COUNT:
      return value >= 0 && value <= INT32_MAX && (counter.points = static_cast<int32_t>(value), true);
    case RUNG_HSIO_COMPARE_START: counter.first = value; return true;
    case RUNG_HSIO_COMPARE_STEP: counter.distance = value; return true;
    case RUNG_HSIO_COMPARE_OUTPUT:
      return value >= -1 && value < RUNG_HSIO_OUTPUTS && (counter.output = static_cast<int8_t>(value), true);
    case RUNG_HSIO_COMPARE_HOLD: counter.hold = value; return value >= 0;
    case RUNG_HSIO_COMPARE_HOLD_PULSES: counter.hold_pulses = value; return value >= 0;
    default:
      if (item < RUNG_HSIO_COMPARE_VALUE) return false;
      counter.point[item - RUNG_HSIO_COMPARE_VALUE] = static_cast<int32_t>(value);
      return true;
  }
}

bool writeCounter(rung_hsio_model& model, uint32_t number, uint32_t item, int64_t value) {
  rung_hsio_counter& counter = model.counters[number];
  const auto flag = static_cast<uint8_t>(value != 0 ? 1 : 0);
  switch (item) {
    case RUNG_HSIO_ENABLE:
      if (flag && !counter.enable) counter.tick_from = model.now;
      counter.enable = flag;
      return true;
    case RUNG_HSIO_MODE:
      if (value < kSingle || value > kDirection) return false;
      if (value != counter.mode) counter.tick_from = model.now;
      counter.mode = static_cast<uint8_t>(value);
      return true;
    case RUNG_HSIO_QUADRUPLE: counter.quadruple = flag; return true;
    case RUNG_HSIO_TICK:
      if (value < 0) return false;
      if (value != counter.tick) counter.tick_from = model.now;
      counter.tick = value;
      return true;
    case RUNG_HSIO_REVERSE: counter.reverse = flag; return true;
    case RUNG_HSIO_LINEAR: counter.linear = flag; return true;
    case RUNG_HSIO_MAXIMUM: counter.maximum = value; return true;
    case RUNG_HSIO_MINIMUM: counter.minimum = value; return true;
    case RUNG_HSIO_LINE_A: return isLineOrNone(value) && (counter.line_a = static_cast<int8_t>(value), true);
    case RUNG_HSIO_LINE_B: return isLineOrNone(value) && (counter.line_b = static_cast<int8_t>(value), true);
    case RUNG_HSIO_LINE_TRIGGER:
      return isLineOrNone(value) && (counter.probe[0].line = static_cast<int8_t>(value), true);
    case RUNG_HSIO_PROBE_LINE_1:
      return isLineOrNone(value) && (counter.probe[1].line = static_cast<int8_t>(value), true);
    case RUNG_HSIO_PROBE_LINE_2:
      return isLineOrNone(value) && (counter.probe[2].line = static_cast<int8_t>(value), true);
    case RUNG_HSIO_TRIGGER_USE:
      return value >= kNoUse && value <= kLatch && (counter.trigger_use = static_cast<uint8_t>(value), true);
    case RUNG_HSIO_PRESET: counter.preset = value; return true;
    case RUNG_HSIO_PRESET_NOW:
      if (counter.trigger_use != kSoftware) return false;
      preset(model, number);
      return true;
    case RUNG_HSIO_Z_USE:
      if ((value & 2) != 0 && (counter.z_use & 2) == 0) counter.has_z = 0;
      counter.z_use = static_cast<uint8_t>(value & 3);
      return true;
    case RUNG_HSIO_RATIO: counter.ratio = value; return true;
    case RUNG_HSIO_COUNT: setCount(model, number, value); return true;
    case RUNG_HSIO_SAMPLE:
      counter.sampled = -1;
      counter.sample_from = counter.pulses;
      counter.sample_end = value > 0 ? model.now + value : kNever;
      return true;
    case RUNG_HSIO_BROKEN: counter.broken = flag; return model.has_signals != 0;
    default: return writeCompare(model, number, item, value);
  }
}

int64_t readOutput(const rung_hsio_output& output, uint32_t item, int64_t now) {
  switch (item) {
    case RUNG_HSIO_OUTPUT_FUNCTION: return output.function;
    case RUNG_HSIO_OUTPUT_LEVEL: return output.pwm ? pwmLevel(output, now) : output.level != 0;
    case RUNG_HSIO_OUTPUT_RISE: return output.rise;
    case RUNG_HSIO_OUTPUT_FALL: return output.fall;
    case RUNG_HSIO_OUTPUT_RISES:
      return output.rises + (output.pwm && output.period > 0 ? (now - output.start) / output.period + 1 : 0);
    case RUNG_HSIO_PWM_PERIOD: return output.period;
    case RUNG_HSIO_PWM_WIDTH: return output.width;
    case RUNG_HSIO_PWM_RUN: return output.pwm;
    default: return 0;
  }
}

bool writeOutput(rung_hsio_model& model, uint32_t number, uint32_t item, int64_t value) {
  rung_hsio_output& output = model.outputs[number];
  switch (item) {
    case RUNG_HSIO_OUTPUT_FUNCTION:
      if (value < 0 || value > kCompareOutput) return false;
      if (output.function != value) setOutput(model, static_cast<int>(number), value == 0 && output.common != 0);
      output.function = static_cast<uint8_t>(value);
      return true;
    case RUNG_HSIO_OUTPUT_LEVEL:
      output.common = value != 0 ? 1 : 0;
      if (output.function == 0) setOutput(model, static_cast<int>(number), value != 0);
      return output.function == 0;
    case RUNG_HSIO_PWM_PERIOD: output.period = value; return value > 0;
    case RUNG_HSIO_PWM_WIDTH: output.width = value; return value >= 0;
    case RUNG_HSIO_PWM_RUN:
      output.rises = readOutput(output, RUNG_HSIO_OUTPUT_RISES, model.now);
      output.pwm = value != 0 ? 1 : 0;
      output.start = model.now;
      return true;
    default: return false;
  }
}

int64_t readUnit(const rung_hsio_model& model, uint32_t item, uint32_t index) {
  switch (item) {
    case RUNG_HSIO_FILTER: return model.filter;
    case RUNG_HSIO_INTERRUPTS_ON: return model.interrupts_on;
    case RUNG_HSIO_INTERRUPT_ENABLE: return model.interrupt_enable;
    case RUNG_HSIO_INTERRUPT_EDGES: return static_cast<int64_t>(model.interrupt_edges);
    case RUNG_HSIO_INTERRUPT_POINTS: return model.interrupt_points;
    case RUNG_HSIO_INTERRUPT_COUNTER: return model.interrupt_counter;
    case RUNG_HSIO_INTERRUPT_COUNT: return index < RUNG_HSIO_INTERRUPTS ? model.interrupt_count[index] : 0;
    case RUNG_HSIO_VERSION: return 1 << 6;
    default: return 0;
  }
}

bool writeUnit(rung_hsio_model& model, uint32_t item, int64_t value) {
  switch (item) {
    case RUNG_HSIO_FILTER: model.filter = value; return value >= 0;
    case RUNG_HSIO_INTERRUPTS_ON: model.interrupts_on = value != 0 ? 1 : 0; return true;
    case RUNG_HSIO_INTERRUPT_ENABLE: model.interrupt_enable = static_cast<uint32_t>(value); return true;
    case RUNG_HSIO_INTERRUPT_EDGES: model.interrupt_edges = static_cast<uint64_t>(value); return true;
    case RUNG_HSIO_INTERRUPT_POINTS: model.interrupt_points = static_cast<uint8_t>(value); return true;
    case RUNG_HSIO_INTERRUPT_COUNTER:
      return value >= 0 && value < kTriggers && (model.interrupt_counter = static_cast<uint8_t>(value), true);
    default: return false;
  }
}

bool isOfLine(uint32_t item) {
  return item <= RUNG_HSIO_FALLS || (item >= RUNG_HSIO_SIGNAL_PERIOD && item <= RUNG_HSIO_SIGNAL_COUNT);
}
bool isOfCounter(uint32_t item) {
  return (item >= RUNG_HSIO_ENABLE && item <= RUNG_HSIO_COMPARE_STEP) ||
         (item >= RUNG_HSIO_COMPARE_VALUE && item < RUNG_HSIO_COMPARE_VALUE + RUNG_HSIO_POINTS);
}
bool isOfOutput(uint32_t item) { return item >= RUNG_HSIO_OUTPUT_FUNCTION && item <= RUNG_HSIO_PWM_RUN; }

}  // namespace

extern "C" {

int64_t rung_hsio_read(const rung_hsio_model* model, uint32_t item, uint32_t index) {
  if (isOfLine(item)) return index < RUNG_HSIO_LINES ? readLine(model->lines[index], item) : 0;
  if (isOfCounter(item)) return index < RUNG_HSIO_COUNTERS ? readCounter(model->counters[index], item) : 0;
  if (isOfOutput(item)) return index < RUNG_HSIO_OUTPUTS ? readOutput(model->outputs[index], item, model->now) : 0;
  return readUnit(*model, item, index);
}

bool rung_hsio_write(rung_hsio_model* model, uint32_t item, uint32_t index, int64_t value) {
  if (isOfLine(item)) return index < RUNG_HSIO_LINES && writeLine(*model, index, item, value);
  if (isOfCounter(item)) return index < RUNG_HSIO_COUNTERS && writeCounter(*model, index, item, value);
  if (isOfOutput(item)) return index < RUNG_HSIO_OUTPUTS && writeOutput(*model, index, item, value);
  return writeUnit(*model, item, value);
}

// AX 4.2.4: the places of the outputs.
void rung_hsio_image_write(rung_hsio_model* model, const uint8_t* outputs) {
  for (uint32_t i = 0; i < RUNG_HSIO_INPUTS; ++i) rung_hsio_write(model, RUNG_HSIO_INPUT_FUNCTION, i, outputs[i]);
  for (uint32_t i = 0; i < RUNG_HSIO_COUNTERS; ++i)
    if (model->counters[i].line_a < 0)
      rung_hsio_write(model, RUNG_HSIO_MODE, i, outputs[16 + i / 2] >> (4 * (i % 2)) & 3);
  model->filter = outputs[20] * int64_t{250};
  for (uint32_t i = 0; i < RUNG_HSIO_OUTPUTS; ++i) {
    rung_hsio_write(model, RUNG_HSIO_OUTPUT_FUNCTION, i, outputs[21 + i]);
    rung_hsio_write(model, RUNG_HSIO_OUTPUT_LEVEL, i, outputs[29] >> i & 1);
  }
  model->interrupts_on = outputs[32] & 1;
  model->interrupt_enable = outputs[36] | uint32_t{outputs[37]} << 8 | uint32_t{outputs[38]} << 16;
  // Inputs have bits 0 to 15, probes 16 to 23.
  model->interrupt_edges = outputs[40] | uint64_t{outputs[41]} << 8 | uint64_t{outputs[42]} << 16;
}

void rung_hsio_image_read(const rung_hsio_model* model, uint8_t* inputs) {
  inputs[0] = inputs[1] = 0;
  for (uint32_t i = 0; i < RUNG_HSIO_INPUTS; ++i)
    if (model->lines[i].level) inputs[i / 8] = static_cast<uint8_t>(inputs[i / 8] | 1u << i % 8);
  inputs[2] = static_cast<uint8_t>(rung_hsio_read(model, RUNG_HSIO_VERSION, 0));
}

}  // extern "C"
