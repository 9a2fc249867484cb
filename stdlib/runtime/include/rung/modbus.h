/* SPDX-License-Identifier: Apache-2.0 */
/* Modbus for hosts: answers requests of a Modbus master from the process image, as the AX manual 3.1.2 and 3.2.2 maps
 * it. In: the data unit of a request (function code and data, without address, unit and checksum). Out: that of the
 * reply. No heap, no state. The bundled host uses it, and a product with a network stack of its own may. */
#ifndef RUNG_MODBUS_H
#define RUNG_MODBUS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What of the image masters can reach: bytes 0..511 of I and Q by bits, words 0..511, and words 0..8192 of M. */
#define RUNG_MODBUS_INPUT_BYTES 1024u
#define RUNG_MODBUS_OUTPUT_BYTES 1024u
#define RUNG_MODBUS_MEMORY_BYTES 16386u
#define RUNG_MODBUS_MEMORY_OFFSET 5000u /* the address of %MX0.0 and of %MW0 */
#define RUNG_MODBUS_MAX_UNIT 253u       /* bytes of a data unit */
#define RUNG_MODBUS_MAX_RTU 256u        /* of a frame on a serial line */
#define RUNG_MODBUS_MAX_TCP 260u

enum rung_modbus_exception {
  RUNG_MODBUS_ILLEGAL_FUNCTION = 1,
  RUNG_MODBUS_ILLEGAL_ADDRESS = 2,
  RUNG_MODBUS_ILLEGAL_VALUE = 3,
  RUNG_MODBUS_NO_TARGET = 11 /* TCP: there is no unit of this number */
};

/* `written`: as many bytes; bits that masters wrote are set there. Null where they cannot write. */
typedef struct rung_modbus_area {
  uint8_t* bytes;
  uint8_t* written;
} rung_modbus_area;
typedef struct rung_modbus_image {
  rung_modbus_area inputs, outputs, memory;
  /* The first holding registers, little-endian; may be null. */
  const uint8_t* registers;
  uint32_t register_count;
} rung_modbus_image;

/* Returns the size of the reply, of at most RUNG_MODBUS_MAX_UNIT bytes: a normal one, or an exception. */
uint32_t rung_modbus_answer(const rung_modbus_image* image, const uint8_t* request, uint32_t size, uint8_t* reply);

uint16_t rung_modbus_crc(const uint8_t* bytes, size_t count);

/* The frame at the begin of `bytes`. Returns its size, 0 while it is incomplete, or -1 for other bytes. */
int32_t rung_modbus_tcp_frame(const uint8_t* bytes, size_t count);
/* A request on a serial line, the checksum included. */
int32_t rung_modbus_rtu_request(const uint8_t* bytes, size_t count);

/* Answers a whole frame for the server `unit`. Returns the size of the reply, 0 for none. */
uint32_t rung_modbus_answer_tcp(const rung_modbus_image* image, uint8_t unit, const uint8_t* frame, uint8_t* reply);
uint32_t rung_modbus_answer_rtu(const rung_modbus_image* image, uint8_t unit, const uint8_t* frame, uint32_t size,
                                uint8_t* reply);

#ifdef __cplusplus
}
#endif
#endif
