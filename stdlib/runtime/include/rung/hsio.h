/* SPDX-License-Identifier: Apache-2.0 */
/* High-speed inputs and outputs: the registers that programs use (rung_hsio in rung/module.h), and a model of the
 * counter unit that has them, for products without such hardware and for simulation (docs/hsio.md). The model
 * is plain data without heap or locks. It is driven by edges, each with its time, and computes counts, latches,
 * comparisons and interrupts at the time of the edge, not of the task. AX 4.2, A.3; TM/TP manual 9. */
#ifndef RUNG_HSIO_H
#define RUNG_HSIO_H

#include "rung/module.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  RUNG_HSIO_COUNTERS = 8,
  RUNG_HSIO_INPUTS = 16,  /* X0 to XF: lines 0 to 15 */
  RUNG_HSIO_LINES = 32,   /* lines 16 + 2n and 17 + 2n: A and B of the encoder input of counter n */
  RUNG_HSIO_OUTPUTS = 8,  /* Y0 to Y7 */
  RUNG_HSIO_POINTS = 100, /* comparison values of a counter */
  RUNG_HSIO_INTERRUPTS = 20
};

/* The registers: `item`, and what its `index` is. Times are nanoseconds. */
enum rung_hsio_item {
  /* by line */
  RUNG_HSIO_LEVEL = 0x00, /* of an input; writing it is an edge */
  RUNG_HSIO_INPUT_FUNCTION =
      0x01,              /* of X0 to XF, AX 4.2.1: 0 common, 1 count, 2 trigger, latch, Z, 3 limit, 4 pulse width */
  RUNG_HSIO_HIGH = 0x02, /* how long it was high last */
  RUNG_HSIO_LOW = 0x03,
  RUNG_HSIO_RISES = 0x04, /* rising edges since the start */
  RUNG_HSIO_FALLS = 0x05,
  /* by counter: configuration */
  RUNG_HSIO_ENABLE = 0x10,
  RUNG_HSIO_MODE = 0x11,      /* AX 4.2.4.4: 0 single pulse, 1 quadrature, 2 timing, 3 pulse and direction */
  RUNG_HSIO_QUADRUPLE = 0x12, /* quadrature: 1 counts each edge */
  RUNG_HSIO_TICK = 0x13,      /* timing: of one count */
  RUNG_HSIO_REVERSE = 0x14,   /* single pulse and timing: 1 counts down */
  RUNG_HSIO_LINEAR = 0x15,    /* 1: the count stays between MINIMUM and MAXIMUM */
  RUNG_HSIO_MAXIMUM = 0x16,
  RUNG_HSIO_MINIMUM = 0x17,
  RUNG_HSIO_LINE_A = 0x18, /* -1: the X input with the function count */
  RUNG_HSIO_LINE_B = 0x19,
  RUNG_HSIO_LINE_TRIGGER = 0x1a, /* -1: the X input with the function trigger */
  RUNG_HSIO_TRIGGER_USE = 0x1b,  /* AX A.3.1, bits 9-11: 0 none, 1 software, 2 trigger, 3 comparison preset, 4 latch */
  RUNG_HSIO_PRESET = 0x1c,       /* the value */
  RUNG_HSIO_PRESET_NOW = 0x1d,   /* written: presets where TRIGGER_USE is 1 */
  RUNG_HSIO_Z_USE = 0x1e,        /* bit 0 clears the count, bit 1 compensates it */
  RUNG_HSIO_RATIO = 0x1f,        /* counts of a turn */
  /* by counter: state */
  RUNG_HSIO_COUNT = 0x20,  /* may be set */
  RUNG_HSIO_PULSES = 0x21, /* counted in either direction since the start */
  RUNG_HSIO_DOWN = 0x22,   /* 1: the last count was down */
  RUNG_HSIO_PRESETS = 0x23,
  RUNG_HSIO_LATCH_RISE = 0x24, /* the count at the last rising edge of the trigger */
  RUNG_HSIO_LATCH_FALL = 0x25,
  RUNG_HSIO_LATCH_RISES = 0x26, /* their numbers */
  RUNG_HSIO_LATCH_FALLS = 0x27,
  RUNG_HSIO_SAMPLE = 0x28,     /* written: counts pulses for that time from now, 0 ends it */
  RUNG_HSIO_SAMPLED = 0x29,    /* pulses of the last complete sample; -1: none is complete */
  RUNG_HSIO_BROKEN = 0x2a,     /* 1: the encoder is disconnected. May be set */
  RUNG_HSIO_LAST_PULSE = 0x2b, /* its time */
  RUNG_HSIO_NET = 0x2d,        /* counts up less counts down since the start: no preset changes it */
  /* by counter: two probes that latch at each edge of a line */
  RUNG_HSIO_PROBE_LINE_1 = 0x30, /* -1: none */
  RUNG_HSIO_PROBE_RISE_1 = 0x31, /* the count at the last rising edge */
  RUNG_HSIO_PROBE_FALL_1 = 0x32,
  RUNG_HSIO_PROBE_RISES_1 = 0x33, /* their numbers */
  RUNG_HSIO_PROBE_FALLS_1 = 0x34,
  RUNG_HSIO_PROBE_LINE_2 = 0x35,
  RUNG_HSIO_PROBE_RISE_2 = 0x36,
  RUNG_HSIO_PROBE_FALL_2 = 0x37,
  RUNG_HSIO_PROBE_RISES_2 = 0x38,
  RUNG_HSIO_PROBE_FALLS_2 = 0x39,
  /* by counter: comparison with up to 100 values. Each value is a value of COMPARE_VALUE + n */
  RUNG_HSIO_COMPARE = 0x40,        /* rung_hsio_compare; writing it starts at the first value */
  RUNG_HSIO_COMPARE_COUNT = 0x41,  /* of the values */
  RUNG_HSIO_COMPARE_OUTPUT = 0x42, /* Y0 to Y7, -1: none */
  RUNG_HSIO_COMPARE_HOLD = 0x43,   /* how long the output is on; 0: not by time */
  RUNG_HSIO_COMPARE_HOLD_PULSES = 0x44,
  RUNG_HSIO_COMPARE_HITS = 0x45,  /* since COMPARE was written */
  RUNG_HSIO_COMPARE_LAST = 0x46,  /* the number of the value that was hit last, from 0; -1: none */
  RUNG_HSIO_COMPARE_TIME = 0x47,  /* of the last hit */
  RUNG_HSIO_COMPARE_EQUAL = 0x48, /* 1 while the count is a value that is compared */
  RUNG_HSIO_COMPARE_START = 0x49, /* values in equal steps, in counts * 2^20: the first, and the distance; */
  RUNG_HSIO_COMPARE_STEP = 0x4a,  /* 0: the values of COMPARE_VALUE */
  RUNG_HSIO_COMPARE_VALUE = 0x100,
  /* by output */
  RUNG_HSIO_OUTPUT_FUNCTION = 0x50, /* AX 4.2.3: 0 common, 1 pulse, 2 comparison */
  RUNG_HSIO_OUTPUT_LEVEL = 0x51,    /* what leaves; writing it sets a common output */
  RUNG_HSIO_OUTPUT_RISE = 0x52,     /* time of the last edge, -1: none */
  RUNG_HSIO_OUTPUT_FALL = 0x53,
  RUNG_HSIO_OUTPUT_RISES = 0x54,
  RUNG_HSIO_PWM_PERIOD = 0x55,
  RUNG_HSIO_PWM_WIDTH = 0x56,
  RUNG_HSIO_PWM_RUN = 0x57, /* written: 1 starts with a high level, 0 stops */
  /* the unit; index 0 but where said */
  RUNG_HSIO_FILTER = 0x60,            /* an input must keep its level that long; 0: none */
  RUNG_HSIO_INTERRUPTS_ON = 0x61,     /* the global enable */
  RUNG_HSIO_INTERRUPT_ENABLE = 0x62,  /* bits 0-7 inputs, 8-15 comparisons, 16-19 probes */
  RUNG_HSIO_INTERRUPT_EDGES = 0x63,   /* 2 bits each, inputs then probes: 0 rising, 1 falling, 2 both */
  RUNG_HSIO_INTERRUPT_POINTS = 0x64,  /* bit n: comparison interrupt n is that of the nth of several values */
  RUNG_HSIO_INTERRUPT_COUNTER = 0x65, /* of those values */
  RUNG_HSIO_INTERRUPT_COUNT = 0x66,   /* by interrupt: how often it occurred */
  RUNG_HSIO_VERSION = 0x67,           /* bits 6-7 major, 3-5 minor, 0-2 revision */
  /* by line: signals of a simulation. Hardware refuses them */
  RUNG_HSIO_SIGNAL_PERIOD = 0x80, /* 0: none. Writing it starts the signal now, high first */
  RUNG_HSIO_SIGNAL_HIGH = 0x81,   /* of each period; 0: half of it. Writing this or the others ends the signal */
  RUNG_HSIO_SIGNAL_DELAY = 0x82,  /* from the start to the first rising edge */
  RUNG_HSIO_SIGNAL_COUNT = 0x83   /* periods; 0: no end */
};

enum rung_hsio_compare {
  RUNG_HSIO_COMPARE_OFF,
  RUNG_HSIO_COMPARE_ANY,   /* each value whenever the count reaches it */
  RUNG_HSIO_COMPARE_ORDER, /* one value after the other, each once */
  RUNG_HSIO_COMPARE_ONCE   /* the first that is reached */
};

typedef struct rung_hsio_signal {
  int64_t period, high, delay, count;
  int64_t start, next; /* next: of the next edge; INT64_MAX: none */
  int64_t edges;       /* that it made */
} rung_hsio_signal;

typedef struct rung_hsio_line {
  uint8_t level, raw, function; /* raw: before the filter */
  int64_t raw_since, since;     /* since: of the last edge; -1: none */
  int64_t high, low, rises, falls;
  rung_hsio_signal signal;
} rung_hsio_line;

typedef struct rung_hsio_probe {
  int8_t line;
  int64_t rise, fall, rises, falls;
} rung_hsio_probe;

typedef struct rung_hsio_counter {
  uint8_t enable, mode, quadruple, reverse, linear, trigger_use, z_use, down, broken, has_z, has_counted;
  int8_t line_a, line_b;
  int64_t tick, tick_from, maximum, minimum, ratio, preset;
  int64_t count, pulses, net, presets, last_pulse, z_count;
  rung_hsio_probe probe[3];                 /* the trigger first */
  int64_t sample_end, sample_from, sampled; /* sample_end INT64_MAX: none runs */
  uint8_t compare, equal;
  int8_t output;
  int32_t points, next_point, last_point, hits;
  int64_t hold, hold_pulses, hit_time, hit_count, first, distance;
  int32_t point[RUNG_HSIO_POINTS];
} rung_hsio_counter;

typedef struct rung_hsio_output {
  uint8_t level, function, common, pwm;
  int64_t rise, fall, rises, off_at; /* off_at: end of a comparison pulse; INT64_MAX: none */
  int64_t period, width, start;
} rung_hsio_output;

typedef struct rung_hsio_model {
  int64_t now;
  uint32_t raised; /* interrupts since the host took them */
  rung_hsio_line lines[RUNG_HSIO_LINES];
  rung_hsio_counter counters[RUNG_HSIO_COUNTERS];
  rung_hsio_output outputs[RUNG_HSIO_OUTPUTS];
  int64_t filter;
  uint8_t interrupts_on, interrupt_points, interrupt_counter, has_signals;
  uint32_t interrupt_enable;
  uint64_t interrupt_edges;
  int64_t interrupt_count[RUNG_HSIO_INTERRUPTS];
} rung_hsio_model;

/* The state after power-on. `has_signals`: of a simulation. */
void rung_hsio_reset(rung_hsio_model* model, bool has_signals);
/* Lets time pass, up to `until` or the first time at which an interrupt occurs: `model->now` is where it stopped. */
void rung_hsio_advance(rung_hsio_model* model, int64_t until);
/* The interrupts that occurred since the last call, by bit as in INTERRUPT_ENABLE. */
uint32_t rung_hsio_take_interrupts(rung_hsio_model* model);
/* The name of the event that starts tasks of an interrupt: in0Interrupt, cmp0Interrupt, prb0Interrupt (AX 4.2.5). */
const char* rung_hsio_event(uint32_t interrupt);
/* An edge of hardware at the time up to which the model has advanced. */
void rung_hsio_edge(rung_hsio_model* model, uint32_t line, bool level);

int64_t rung_hsio_read(const rung_hsio_model* model, uint32_t item, uint32_t index);
bool rung_hsio_write(rung_hsio_model* model, uint32_t item, uint32_t index, int64_t value);

/* The device HIGH_PULSE_IO of the AX controllers (4.2.4): 3 bytes of inputs and 44 of outputs. */
enum { RUNG_HSIO_IMAGE_INPUTS = 3, RUNG_HSIO_IMAGE_OUTPUTS = 44 };
void rung_hsio_image_read(const rung_hsio_model* model, uint8_t* inputs);
void rung_hsio_image_write(rung_hsio_model* model, const uint8_t* outputs);

#ifdef __cplusplus
}
#endif
#endif
