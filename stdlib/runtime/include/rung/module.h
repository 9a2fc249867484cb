/* SPDX-License-Identifier: Apache-2.0 */
/* The module interface: how a compiled project looks to the product that runs it (docs/embedding.md).
 * A module is code without writable statics. The host owns all memory: it allocates the blocks and areas, calls init,
 * then runs tasks; it may read and force every variable through the symbols. Plain C, no heap, no locks.
 * The bundled host (rung/host.h) is one user of this header. */
#ifndef RUNG_MODULE_H
#define RUNG_MODULE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The function of a module is visible outside of a shared library; its other symbols are not. */
#define RUNG_EXPORT __attribute__((visibility("default")))
#define RUNG_HIDDEN __attribute__((visibility("hidden")))

/* Two versions, promised in docs/embedding.md. ABI: of the structures and functions in this header; a host runs modules
 * of its own number. What later headers may add without raising it is said at rung_table and rung_extension. LAYOUT: of
 * the rules by which the variables of a program lie in the blocks. */
#define RUNG_MODULE_ABI 16u
#define RUNG_MODULE_LAYOUT 1u
#define RUNG_NONE 0xffffffffu

typedef struct rung_context rung_context;

/* ---- tables. A later header may add columns at the end of a row, and its modules run on older hosts: a table is
 * walked by its own row size, never by the size of the structure. */
typedef struct rung_table {
  const void* rows;
  uint32_t count, row_size; /* bytes of a row */
} rung_table;

/* The row with this index, where it lies. Every module has the columns of the first header with RUNG_MODULE_ABI. */
static inline const void* rung_row(const rung_table* table, uint32_t index) {
  return (const char*)table->rows + (size_t)index * table->row_size;
}

/* Copies a row of a structure with `size` bytes. Columns that the module does not have are 0. */
static inline void rung_copy_row(const rung_table* table, uint32_t index, void* row, size_t size) {
  memset(row, 0, size);
  memcpy(row, rung_row(table, index), size < table->row_size ? size : table->row_size);
}

/* What a later header adds beside the tables and functions of a module, or beside the services of a host. A receiver
 * ignores names that it does not know. A structure may grow at its end: its size says what is there. */
typedef struct rung_extension {
  const char* name;
  const void* data; /* a structure of `size` bytes */
  uint32_t size;
} rung_extension;

/* The extension of this name in a table of rung_extension; null: there is none. */
static inline const rung_extension* rung_find_extension(const rung_table* extensions, const char* name) {
  for (uint32_t i = 0; i < extensions->count; ++i) {
    const rung_extension* extension = (const rung_extension*)rung_row(extensions, i);
    if (strcmp(extension->name, name) == 0) return extension;
  }
  return NULL;
}

/* The extension `rung.names` of a module: a table of hashes that finds names in constant time. Modules with few names
 * have none; theirs are compared one by one. */
#define RUNG_NAMES "rung.names"
typedef struct rung_names {
  /* A row is a uint16_t or a uint32_t: 1 + the index of a symbol, or 1 + the number of symbols + the index of a field;
   * 0: no name. The search for a name begins at rung_name_slot and ends at the first row with 0. Of symbols with the
   * same name, and of equal hashes, the lower index comes first. */
  rung_table slots;
} rung_names;
/* The hash of a name begins with the seed of its owner, and takes its characters one after the other. `owner`:
 * rung_type::first of the record that has the field; of symbols RUNG_NONE. */
static inline uint32_t rung_name_seed(uint32_t owner) { return 2166136261u ^ owner * 0x9e3779b1u; }
static inline uint32_t rung_name_hash(uint32_t hash, char c) {
  return (hash ^ (uint8_t)(c >= 'A' && c <= 'Z' ? c + 32 : c)) * 16777619u;
}
static inline uint32_t rung_name_slot(uint32_t hash, uint32_t slots) {
  return (uint32_t)((uint64_t)(hash * 0x85ebca6bu) * slots >> 32);
}

/* ---- types, for monitoring, forcing and traces. Index 0 of every table is a valid entry. */
typedef enum rung_type_kind {
  RUNG_BOOL,
  RUNG_BYTE,
  RUNG_WORD,
  RUNG_DWORD,
  RUNG_LWORD,
  RUNG_SINT,
  RUNG_INT,
  RUNG_DINT,
  RUNG_LINT,
  RUNG_USINT,
  RUNG_UINT,
  RUNG_UDINT,
  RUNG_ULINT,
  RUNG_REAL,
  RUNG_LREAL,
  RUNG_TIME,
  RUNG_LTIME,
  RUNG_DATE,
  RUNG_LDATE,
  RUNG_TOD,
  RUNG_LTOD,
  RUNG_DT,
  RUNG_LDT,
  RUNG_CHAR,
  RUNG_WCHAR,
  RUNG_UCHAR,   /* a code point in 32 bits */
  RUNG_STRING,  /* length: capacity in bytes; length+1 bytes, NUL-terminated */
  RUNG_WSTRING, /* the same in 16-bit units */
  RUNG_USTRING, /* as RUNG_STRING, UTF-8 */
  RUNG_ENUM,    /* element: the integer type; first, count: slice of enum_items */
  RUNG_ARRAY,   /* element; first, count: slice of dimensions */
  RUNG_RECORD,  /* struct, function block, program, global list; first, count: slice of fields */
  RUNG_POINTER  /* element: the target type */
} rung_type_kind;

typedef struct rung_type {
  uint8_t kind;      /* rung_type_kind */
  uint8_t is_signed; /* TIME: signed in iec, unsigned in codesys */
  uint8_t library;   /* a function block of a library: users see its pins */
  uint32_t name;     /* offset in `strings` */
  uint32_t size;     /* bytes */
  uint32_t element;  /* type index or RUNG_NONE */
  uint32_t length;
  uint32_t first, count;
} rung_type;

enum rung_field_flags {
  RUNG_FIELD_BY_REFERENCE = 1, /* the memory holds a pointer to the variable (VAR_IN_OUT) */
  RUNG_FIELD_CONSTANT = 2,
  RUNG_FIELD_RETAIN = 4,
  RUNG_FIELD_PERSISTENT = 8,
  RUNG_FIELD_INPUT = 16,
  RUNG_FIELD_OUTPUT = 32,
  RUNG_FIELD_BASE = 64,       /* the block that this one extends: its fields are named as if declared here */
  RUNG_FIELD_READ_ONLY = 128, /* of a VAR_ACCESS: may be read, not set */
  RUNG_FIELD_BIT = 0xf00,     /* of a BOOL that is one bit of the byte at its offset: the bit's number + 1; else 0 */
  RUNG_FIELD_NO_EXTERNAL_READ = 0x1000, /* {attribute 'symbol'}: what a host should not offer to tools outside */
  RUNG_FIELD_NO_EXTERNAL_WRITE = 0x2000,
  RUNG_FIELD_NO_COPY = 0x4000,   /* an online change sets its initial value: {attribute 'no_copy'} */
  RUNG_FIELD_OPEN_ARRAY = 0x8000 /* a pointer to the first element of an array that each call binds (ARRAY[*]) */
};
#define RUNG_FIELD_BIT_SHIFT 8
typedef struct rung_field {
  uint32_t name, type, offset, flags;
} rung_field;
typedef struct rung_enum_item {
  uint32_t name;
  int64_t value;
} rung_enum_item;
typedef struct rung_dimension {
  int64_t low, high;
} rung_dimension;

/* The initial values of a record that does not begin with zeros. `init` sets them in an instance whose memory is 0, the
 * instances in it included; rung_init_instance calls it. */
typedef struct rung_initialiser {
  uint32_t type; /* of kind RUNG_RECORD; rows are in ascending order */
  void (*init)(rung_context*, void* instance);
} rung_initialiser;

/* A root of the symbol map: a program instance, a global variable or a located variable. */
enum rung_storage { RUNG_IN_BLOCK = 0, RUNG_IN_AREA = 1 };
typedef struct rung_symbol {
  uint32_t name; /* `Main`, `level`, `Main.valve` for a located variable of a program */
  uint32_t type;
  uint8_t storage; /* rung_storage */
  uint8_t bit;     /* of a BOOL in an area (0..7), else 255 */
  uint8_t is_program;
  uint32_t index;  /* of the block or area */
  uint32_t offset; /* bytes in it */
  uint32_t flags;  /* rung_field_flags */
  uint32_t path;   /* `Config.Resource.` or '' that may precede it: offset in strings */
} rung_symbol;

/* A range that warm starts keep (retain) or that downloads keep too (persistent). `block` is the index of a block, or
 * RUNG_RANGE_AREA + that of an area. With RUNG_RANGE_BIT too, the range is one bit: `offset` counts bits, and it is
 * kept as a byte of 0 or 1. */
#define RUNG_RANGE_AREA 0x80000000u
#define RUNG_RANGE_BIT 0x40000000u
typedef struct rung_range {
  uint32_t block, offset, size;
} rung_range;

typedef struct rung_block {
  uint32_t name, size, align;
} rung_block;

/* A memory area that addresses name, little-endian. The first three are I, Q and M of IEC 61131-3; a product may have
 * further ones (`[area ...]` in rung.project). */
enum rung_area_owner {
  RUNG_AREA_INPUT,  /* the host writes it before a cycle */
  RUNG_AREA_OUTPUT, /* the host takes it after a cycle, and sets it to safe values after a fault */
  RUNG_AREA_MEMORY, /* neither: memory of the program, or what the product defines */
  RUNG_AREA_SHARED /* as memory; tasks write different bits of a word: a host with copies takes the bits that changed */
};
typedef struct rung_area {
  uint32_t name;   /* `I` */
  uint32_t prefix; /* with which its addresses begin: `%I` */
  uint32_t size;   /* bytes */
  uint8_t owner;   /* rung_area_owner */
} rung_area;

/* ---- tasks */
typedef enum rung_task_kind { RUNG_CYCLIC, RUNG_FREEWHEELING, RUNG_EVENT, RUNG_STATUS, RUNG_EXTERNAL } rung_task_kind;
typedef struct rung_task {
  uint32_t name;
  uint8_t kind;        /* rung_task_kind */
  uint32_t priority;   /* 0 highest .. 31 */
  int64_t interval_ns; /* of an EVENT task that is not 0: it also runs cyclically while its trigger is FALSE */
  int64_t watchdog_ns; /* 0: none */
  uint32_t sensitivity;
  uint32_t trigger;                  /* EVENT, STATUS: path of a BOOL, offset in strings */
  uint32_t external_event;           /* EXTERNAL: name, offset in strings */
  uint32_t resource;                 /* index into the module's resources: tasks of one never run at the same instant */
  uint32_t first_write, write_count; /* slice of the module's writes */
  int64_t duration_ns;               /* how long an activation takes in a simulation; 0: no time */
  void (*run)(rung_context*);
} rung_task;

/* What a task may write of outputs and memory areas. A host that gives each task a copy of the areas takes this from it
 * at the end of an activation, all together. */
typedef struct rung_write {
  uint8_t area;
  uint8_t mask; /* the bits of one byte; 255: whole bytes */
  uint32_t offset, size;
} rung_write;

/* What a host tells the program about each task (rung_context::task_states). Times in nanoseconds. */
typedef struct rung_task_state {
  uint32_t activations;                               /* that are complete */
  uint32_t overruns;                                  /* starts that were dropped because the task still ran */
  int64_t last_ns, shortest_ns, longest_ns, total_ns; /* execution times, interruptions included */
  int64_t last_start_ns;                              /* program time at which it last began */
  int64_t earliest_ns, latest_ns; /* bounds of the jitter: how far its periods were shorter (< 0) or longer than set */
} rung_task_state;

/* A device of a product, which the host reads before and writes after each activation of the task it belongs to. Its
 * inputs and outputs are parts of the input area (0) and the output area (1). */
typedef struct rung_driver {
  const char* name;
  const char* task; /* the bus cycle task; null: the cyclic task with the shortest interval */
  uint32_t input_offset, input_size, output_offset, output_size;
  bool (*read)(void* data, uint8_t* inputs, int64_t now_ns); /* false: an error. May be null, as `write` */
  bool (*write)(void* data, const uint8_t* outputs, int64_t now_ns);
  void* data;
  /* The program has stopped: the `write` that follows brings the safe values, the one after that says that it runs
   * again. May be null. */
  void (*stopped)(void* data, int64_t now_ns);
} rung_driver;

/* A device that the project describes (`[module NAME]` of rung.project), for the driver that serves it. Its channels
 * lie in the input and output areas in the order of the manual, each at a multiple of its size. */
typedef struct rung_io_module {
  uint32_t name, type; /* offsets in strings */
  uint32_t station;    /* the coupler that it is connected to: offset in strings; '': the controller's rack */
  uint32_t task;       /* index of the bus cycle task; RUNG_NONE: the cyclic task with the shortest interval */
  uint32_t input_offset, output_offset;
} rung_io_module;

/* One test of `rung test`. A test with a `done` variable runs until that is TRUE. */
typedef struct rung_test {
  uint32_t name;
  uint32_t file;
  uint32_t line;
  uint32_t done_block, done_offset; /* RUNG_NONE: runs once */
  void (*init)(rung_context*);
  void (*run)(rung_context*);
  void (*exit)(rung_context*); /* ends the objects of the test (FB_Exit), in front of rung_module::exit; or null */
} rung_test;

/* ---- faults */
typedef enum rung_fault_kind {
  RUNG_FAULT_NONE,
  RUNG_FAULT_DIV,
  RUNG_FAULT_INDEX,
  RUNG_FAULT_NULL,
  RUNG_FAULT_CAST,
  RUNG_FAULT_SUBRANGE,
  RUNG_FAULT_CONVERT,
  RUNG_FAULT_OVERFLOW,
  RUNG_FAULT_LOCK,  /* a MUTEX or SEMA: value is a rung_lock_error */
  RUNG_FAULT_STACK, /* calls nest too deep; noticed in interpreted modules, and by the bundled host */
  RUNG_FAULT_STOP   /* the host ends the activation: value is a rung_stop. No __TRY sees it */
} rung_fault_kind;
/* rung_fault.value of two faults that differ from others of their kind. */
#define RUNG_NO_SUCH_METHOD 1 /* CAST: a call of something that is not an object with that method */
enum rung_lock_error {
  RUNG_LOCK_FREE,    /* no error */
  RUNG_LOCK_HELD,    /* LOCK: another task has it, and cannot unlock it while this one waits */
  RUNG_LOCK_OWN,     /* LOCK: this task has it */
  RUNG_LOCK_NOT_OWN, /* UNLOCK: this task does not have it */
  RUNG_SEMA_EMPTY,   /* ACQUIRE: all are taken, and no task can release one while this one waits */
  RUNG_SEMA_FULL     /* RELEASE: none is taken */
};
/* Why an activation was ended before it was complete. */
enum rung_stop {
  RUNG_STOP_NONE,
  RUNG_STOP_STEPS, /* it used up rung_context::step_limit */
  RUNG_STOP_TIME,
  RUNG_STOP_INTERRUPT
};
#define RUNG_BAD_ADDRESS (-1) /* NULL: the program accessed invalid memory; from the bundled host */
/* The location of a check: a table of the module, indexed by the number that the code passes. */
typedef struct rung_site {
  uint32_t pou, file; /* offsets in strings */
  uint32_t line, column;
  int64_t low, high; /* bounds */
} rung_site;
typedef struct rung_fault {
  uint8_t kind;  /* rung_fault_kind */
  uint32_t site; /* index into module->sites */
  int64_t value; /* for example the index */
} rung_fault;
/* A call that led to a fault. */
typedef struct rung_caller {
  uint32_t site;        /* index into module->sites: the POU that calls, and where */
  const void* instance; /* that it calls; null: a function, or it cannot be told any more */
} rung_caller;
#define RUNG_CALLERS 32 /* that are kept, the innermost */

/* An assertion of a test: its location and the content of its report. Absent strings are null. */
typedef struct rung_assertion {
  const char* file;
  uint32_t line, column;
  const char* source;  /* the line of the program */
  const char* message; /* of its author */
  const char* shown;   /* ASSERT(a > b): `a > b`, `a` and `b`, one per line; empty for a literal */
  const char* items;   /* enumerations: `name\0value\0name\0value\0\0`, values decimal */
} rung_assertion;

/* ---- the host's side */

/* Files of the program. Names have '/' between folders; a file is a number > 0. A failing call returns a negative
 * rung_file_error. Positions and counts are bytes. */
typedef enum rung_file_error {
  RUNG_FILE_MISSING = -1,
  RUNG_FILE_DENIED = -2,
  RUNG_FILE_EXISTS = -3,
  RUNG_FILE_NAME = -4,   /* leaves the folder that the program may use, or is empty */
  RUNG_FILE_HANDLE = -5, /* not open, or not open for this */
  RUNG_FILE_FAILED = -6,
  RUNG_FILE_BUSY = -7,     /* of work that is not complete */
  RUNG_FILE_TOO_LARGE = -8 /* more bytes than the work may copy */
} rung_file_error;
enum rung_file_mode {
  RUNG_FILE_READ = 1,
  RUNG_FILE_WRITE = 2,
  RUNG_FILE_APPEND = 4, /* every write goes to the end */
  RUNG_FILE_CREATE = 8, /* if it does not exist */
  RUNG_FILE_TRUNCATE = 16,
  RUNG_FILE_NEW = 32 /* with CREATE: it must not exist */
};

/* Work on files that the host does off the cycle: a program begins it, and asks for the result in later cycles. */
typedef enum rung_file_work_kind {
  RUNG_WORK_OPEN,   /* `name`, rung_file_mode: the file */
  RUNG_WORK_WRITE,  /* `bytes` to `file`: the count */
  RUNG_WORK_CLOSE,  /* `file`: 0 */
  RUNG_WORK_LIST,   /* a folder; bytes: rung_file_entry rows. The count of rows */
  RUNG_WORK_COPY,   /* a file or a folder with its content to the folder `target`: 0 */
  RUNG_WORK_REMOVE, /* a file or a folder with its content: 0 */
  RUNG_WORK_READ    /* up to `count` bytes of `file`: the count of bytes, 0 at the end */
} rung_file_work_kind;
enum rung_file_work_flags {
  RUNG_WORK_ONLY_FILES = 1, /* LIST */
  RUNG_WORK_OVERWRITE = 2   /* COPY: existing files are replaced */
};
#define RUNG_WORK_BYTES 4096 /* that one WRITE or READ may have */
typedef struct rung_file_work {
  uint8_t kind;       /* rung_file_work_kind */
  uint32_t flags;     /* rung_file_work_flags, or the rung_file_mode */
  int64_t file;       /* WRITE, READ, CLOSE */
  const char* name;   /* all others */
  const char* target; /* COPY */
  const void* bytes;  /* WRITE */
  uint64_t count;     /* WRITE, READ: bytes; LIST: rows at most; COPY: bytes of a file at most, 0: any */
} rung_file_work;
typedef struct rung_file_entry {
  char name[256];
  uint64_t size;
  int64_t modified_s; /* since 1970-01-01 UTC */
  uint8_t is_folder;
} rung_file_entry;

typedef struct rung_files {
  int64_t (*open)(void* data, const char* name, uint32_t mode);
  int64_t (*close)(void* data, int64_t file);
  int64_t (*read)(void* data, int64_t file, void* bytes, uint64_t count); /* bytes read; 0 at the end */
  int64_t (*write)(void* data, int64_t file, const void* bytes, uint64_t count);
  int64_t (*seek)(void* data, int64_t file, int64_t offset, int from); /* 0 begin, 1 here, 2 end: the position */
  int64_t (*size)(void* data, const char* name);
  int64_t (*remove)(void* data, const char* name);
  int64_t (*rename)(void* data, const char* from, const char* to);
  int64_t (*make_folder)(void* data, const char* name);
  int64_t (*remove_folder)(void* data, const char* name);
  /* Begins work, whose strings and bytes it copies: a number > 0, or an error. Does not wait. */
  int64_t (*begin)(void* data, const rung_file_work* work);
  /* RUNG_FILE_BUSY, or its result: then up to `capacity` bytes that it found are copied to `bytes`, and its number is
   * free again. Does not wait. */
  int64_t (*result)(void* data, int64_t work, void* bytes, uint64_t capacity);
} rung_files;

/* Addresses of an Ethernet port: 192.168.1.10 is 0xc0a8010a. */
typedef struct rung_network {
  uint32_t address, mask, gateway;
} rung_network;

/* High-speed inputs and outputs: registers of a counter unit, listed in rung/hsio.h. `now_ns` is the time of the
 * activation. */
typedef struct rung_hsio {
  int64_t (*read)(void* data, uint32_t item, uint32_t index, int64_t now_ns); /* 0 where there is no such register */
  bool (*write)(void* data, uint32_t item, uint32_t index, int64_t value, int64_t now_ns); /* false: refused */
} rung_hsio;

/* Drives of axes: rung/motion.h. */
typedef struct rung_drives rung_drives;

/* The numerical control of an NCT program: rung/nc.h. */
typedef struct rung_nc rung_nc;

/* Current faults of the controller, its modules and its links: rung/diagnosis.h. */
typedef struct rung_diagnosis rung_diagnosis;
/* Serial lines, TCP and UDP. A channel is a number > 0. No function waits: what takes time goes on between the calls,
 * and `status` tells how far it is. A failing call returns a negative rung_channel_error. Buffers have a fixed size. */
typedef enum rung_channel_error {
  RUNG_CHANNEL_DENIED = -1,  /* the host has no channels of this kind */
  RUNG_CHANNEL_ADDRESS = -2, /* not an IPv4 address, not one of this machine, or no such serial port */
  RUNG_CHANNEL_HANDLE = -3,  /* not open, or not open for this */
  RUNG_CHANNEL_IN_USE = -4,  /* another channel or program has the port */
  RUNG_CHANNEL_LIMIT = -5,   /* too many channels, or bytes */
  RUNG_CHANNEL_REFUSED = -6, /* the peer does not accept the connection, or cannot be reached */
  RUNG_CHANNEL_CLOSED = -7,  /* by the peer */
  RUNG_CHANNEL_SETTING = -8, /* a rate, format or unit that does not exist */
  RUNG_CHANNEL_FAILED = -9
} rung_channel_error;
enum rung_channel_kind {
  RUNG_CHANNEL_SERIAL = 1,
  RUNG_CHANNEL_TCP_CLIENT = 2,
  RUNG_CHANNEL_TCP_SERVER = 3,
  RUNG_CHANNEL_TCP_ACCEPT = 4, /* of a TCP server: opens when a client comes */
  RUNG_CHANNEL_UDP = 5,
  RUNG_CHANNEL_UDP_SENDER = 6, /* does not receive; shares its port with a RUNG_CHANNEL_UDP */
  RUNG_CHANNEL_MODBUS_TCP = 7, /* Modbus servers: the host answers, from the image at cycle borders (rung/modbus.h) */
  RUNG_CHANNEL_MODBUS_RTU = 8,
  RUNG_CHANNEL_SERIAL_PEER = 9 /* the other end of a serial line, in tests */
};
enum rung_parity { RUNG_PARITY_NONE, RUNG_PARITY_ODD, RUNG_PARITY_EVEN };
typedef struct rung_channel_settings {
  uint8_t kind;        /* rung_channel_kind */
  uint16_t port;       /* of TCP and UDP; the number of the serial port */
  const char* address; /* of a TCP client: the peer's; else the own one, empty for all. Read during `open` only */
  int64_t server;      /* of RUNG_CHANNEL_TCP_ACCEPT */
  uint32_t rate;       /* of serial lines: bit/s */
  uint8_t data_bits, parity, stop_bits;
  uint8_t unit; /* the number under which a Modbus server answers */
} rung_channel_settings;
typedef struct rung_channel_status {
  int32_t state;     /* 0 opening, 1 open, or a rung_channel_error: it opens no more, or is closed and all is read */
  uint32_t readable; /* bytes that `read` gives at once; of UDP: of the next datagram */
  uint32_t unsent;   /* bytes that were written and have not left yet */
} rung_channel_status;
/* A peer of a datagram: 127.0.0.1 is 16#7F000001. */
typedef struct rung_endpoint {
  uint32_t address;
  uint16_t port;
} rung_endpoint;
typedef struct rung_channels {
  int64_t (*open)(void* data, const rung_channel_settings* settings);
  int64_t (*status)(void* data, int64_t channel, rung_channel_status* status);
  /* Bytes read, 0 when there are none. One datagram at a time, cut to `count`; `from` gets its sender, or is null. */
  int64_t (*read)(void* data, int64_t channel, void* bytes, uint64_t count, rung_endpoint* from);
  /* Bytes taken, fewer than `count` when the buffer is full; a datagram whole or not at all. To a Modbus server: the
   * values of its first holding registers, in the byte order of the machine, instead of those of the image. */
  int64_t (*write)(void* data, int64_t channel, const void* bytes, uint64_t count, const rung_endpoint* to);
  int64_t (*close)(void* data, int64_t channel);
} rung_channels;

enum rung_severity { RUNG_MESSAGE_NOTE, RUNG_MESSAGE_WARNING, RUNG_MESSAGE_ERROR };

typedef struct rung_host {
  /* Wall clock, nanoseconds since 1970-01-01 UTC. Default: 0 at the start, then task time. */
  int64_t (*wall_clock)(void* data);
  /* An assertion of a test. Values are formatted as in the trace; null when it passed. */
  void (*assertion)(void* data, const rung_assertion* assertion, bool passed, const char* expected, const char* actual);
  /* A call of a POU in an interpreted module whose calls are traced; `instance` is null for a function. */
  void (*called)(void* data, const char* pou, const void* instance);
  /* A message of the program to its operator (ADSLOGSTR). Default: none. `severity` is a rung_severity. */
  void (*message)(void* data, uint8_t severity, const char* text);
  /* Default (null): opening fails as RUNG_FILE_DENIED. */
  const rung_files* files;
  void* files_data;
  /* Default (null): opening fails as RUNG_CHANNEL_DENIED. */
  const rung_channels* channels;
  void* channels_data;
  /* Lets other tasks run while this one waits for a MUTEX or SEMA; returns 0 when they cannot, or the program ends.
   * Default (null): 0. */
  int (*wait)(void* data);
  /* The name of the machine, and its IPv4 address. Default (null): unknown. */
  const char* name;
  /* Sets the clock that wall_clock returns; false: it cannot. Default (null): false. */
  bool (*set_wall_clock)(void* data, int64_t ns);
  /* Reads and sets the addresses of an Ethernet port, from 1; false: there is no such port, or it cannot be set.
   * Default (null): false. */
  bool (*network)(void* data, uint32_t port, rung_network* addresses);
  bool (*set_network)(void* data, uint32_t port, const rung_network* addresses);
  /* The table of current faults, in which the program and the host report and which both read. Default (null): none. */
  rung_diagnosis* diagnosis;
  /* Default (null): there are no high-speed inputs and outputs. */
  const rung_hsio* hsio;
  void* hsio_data;
  const char* address;
  /* Default (null): every axis has a simulated drive. */
  const rung_drives* drives;
  void* drives_data;
  /* A fault is about to leave the program's code for the host (a __TRY handles others): ctx->fault says which, and the
   * calls that led to it are still on the stack. Default (null): nothing. */
  void (*faulted)(void* data, const rung_context* ctx);
  /* Default (null): instructions that ask the control set FL_ER. */
  const rung_nc* nc;
  void* nc_data;
  rung_table extensions; /* services that later headers describe */
} rung_host;

struct rung_context {
  void** blocks;   /* one per module block */
  uint8_t** areas; /* one per module area; they stay where they are while a function of the module runs */
  int64_t now_ns;  /* time of this activation, from 0 at the start */
  const struct rung_module* module;
  const rung_host* host;
  void* host_data;
  rung_fault fault;   /* of the last run that faulted */
  void* fault_target; /* jmp_buf of the innermost rung_guarded call or __TRY */
  /* The row of rung_task, rung_test or rung_initialiser whose function runs, set by a host that runs interpreted
   * modules: one function serves all of them. Compiled modules do not read it. */
  const void* entry;
  uint32_t task;                      /* the number of the task that runs, from 1; 0 outside of tasks */
  uint32_t activation;                /* of that task: 1 the first time */
  const rung_task_state* task_states; /* one per task, or null */
  /* Bounds of an activation, in interpreted modules and in those that `rung run` and `rung test` compile; other
   * compiled modules do not read them. A step is an iteration of a loop, a label that is passed, or a call of a POU. */
  int64_t step_limit;            /* 0: none */
  int64_t steps;                 /* left; below 0 the code asks rung_poll */
  volatile uint8_t stop;         /* a rung_stop, set by others, such as a signal handler, to end the activation */
  void* stop_target;             /* jmp_buf of the outermost rung_guarded */
  const char* volatile cpp_body; /* the body in C++ that runs: path, line and POU, a line each; or null */
  /* How the last fault was reached, the innermost call first. Interpreted modules tell it, and compiled ones that were
   * compiled with -DRUNG_CALL_PATHS; see rung/call_paths.h. */
  rung_caller callers[RUNG_CALLERS];
  uint32_t caller_count; /* may be more than RUNG_CALLERS */
};

typedef enum rung_start { RUNG_COLD, RUNG_WARM, RUNG_ORIGIN } rung_start;

enum rung_module_flags {
  RUNG_ALIGNED_GLOBALS = 1 /* each task works on a copy of the global variables, which it exchanges at its borders */
};
typedef struct rung_module {
  uint32_t abi;    /* RUNG_MODULE_ABI */
  uint32_t layout; /* RUNG_MODULE_LAYOUT */
  uint32_t pointer_size;
  uint32_t flags; /* rung_module_flags */
  const char* name;
  const char* compiler;    /* version of rung */
  const char* strings;     /* all names, NUL-terminated, by offset */
  uint64_t layout_hash;    /* of blocks, offsets and types: retained data of another hash does not fit */
  rung_table blocks;       /* rung_block */
  rung_table areas;        /* rung_area */
  rung_table resources;    /* uint32_t: names, offsets in strings */
  rung_table tasks;        /* rung_task */
  rung_table writes;       /* rung_write */
  rung_table io_modules;   /* rung_io_module */
  rung_table symbols;      /* rung_symbol */
  rung_table types;        /* rung_type */
  rung_table fields;       /* rung_field */
  rung_table enum_items;   /* rung_enum_item */
  rung_table dimensions;   /* rung_dimension */
  rung_table retain;       /* rung_range */
  rung_table persistent;   /* rung_range */
  rung_table sites;        /* rung_site */
  rung_table initialisers; /* rung_initialiser */
  rung_table tests;        /* rung_test */
  rung_table extensions;   /* rung_extension */
  /* Sets every variable to its initial value; located variables without one leave the image as it is. */
  void (*init)(rung_context*);
  /* Ends all objects (FB_Exit); called once, before the memory is released or init is called again. May be null. */
  void (*exit)(rung_context*);
  /* Sets outputs that have safe values other than 0 (`[safe]` of rung.project); a host calls it through rung_guarded,
   * with areas that are 0 otherwise, when the program stops. May be null. */
  void (*safe)(rung_context*);
  /* For rung_context::callers; each may be null. Of an interpreted module: finds them on the stack. Of a compiled one:
   * runs code that may be left by the second (rung/call_paths.h). */
  void (*find_callers)(rung_context*);
  void (*run_catching)(rung_context*, void (*run)(void* frame), void* frame);
  void (*throw_fault)(void);
} rung_module;

/* Rows of the tables, as rung_row gives them. */
static inline const rung_block* rung_block_at(const rung_module* module, uint32_t index) {
  return (const rung_block*)rung_row(&module->blocks, index);
}
static inline const rung_area* rung_area_at(const rung_module* module, uint32_t index) {
  return (const rung_area*)rung_row(&module->areas, index);
}
static inline const rung_task* rung_task_at(const rung_module* module, uint32_t index) {
  return (const rung_task*)rung_row(&module->tasks, index);
}
static inline const rung_write* rung_write_at(const rung_module* module, uint32_t index) {
  return (const rung_write*)rung_row(&module->writes, index);
}
static inline const rung_io_module* rung_io_module_at(const rung_module* module, uint32_t index) {
  return (const rung_io_module*)rung_row(&module->io_modules, index);
}
static inline const rung_symbol* rung_symbol_at(const rung_module* module, uint32_t index) {
  return (const rung_symbol*)rung_row(&module->symbols, index);
}
static inline const rung_type* rung_type_at(const rung_module* module, uint32_t index) {
  return (const rung_type*)rung_row(&module->types, index);
}
static inline const rung_field* rung_field_at(const rung_module* module, uint32_t index) {
  return (const rung_field*)rung_row(&module->fields, index);
}
static inline const rung_enum_item* rung_enum_item_at(const rung_module* module, uint32_t index) {
  return (const rung_enum_item*)rung_row(&module->enum_items, index);
}
static inline const rung_dimension* rung_dimension_at(const rung_module* module, uint32_t index) {
  return (const rung_dimension*)rung_row(&module->dimensions, index);
}
static inline const rung_site* rung_site_at(const rung_module* module, uint32_t index) {
  return (const rung_site*)rung_row(&module->sites, index);
}
static inline const rung_test* rung_test_at(const rung_module* module, uint32_t index) {
  return (const rung_test*)rung_row(&module->tests, index);
}

/* Every module exports one function, <name>_module, that returns its description. */
typedef const rung_module* (*rung_module_function)(void);

/* ---- services of the runtime for hosts and generated code (librung_runtime) */

/* Runs `run` and catches its faults: RUNG_FAULT_NONE, or the kind, details in ctx->fault. */
uint8_t rung_guarded(rung_context* ctx, void (*run)(rung_context*));

/* Sets an instance to the initial values of its type, a record: zeros, then what rung_initialiser says, guarded in the
 * same way: FB_Init runs, of the instance itself only where it has no inputs but the two of the system. */
uint8_t rung_init_instance(rung_context* ctx, uint32_t type, void* instance);

/* Leaves generated code. Called by checks. */
#if defined(__GNUC__)
__attribute__((noreturn, cold))
#endif
void rung_raise(rung_context *ctx, uint8_t kind, uint32_t site, int64_t value);
/* The same from the handler of a signal: rung_context::callers stays empty. */
#if defined(__GNUC__)
__attribute__((noreturn, cold))
#endif
void rung_raise_crash(rung_context *ctx, uint8_t kind, uint32_t site, int64_t value);

#ifdef __cplusplus
}
#endif
#endif
