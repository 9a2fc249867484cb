// SPDX-License-Identifier: Apache-2.0
/* The other side of Modbus tests, with libmodbus.
 *   modbus_peer slave tcp PORT | rtu DEVICE      answers until the holding register 999 is written
 *   modbus_peer master tcp PORT | rtu DEVICE     reads and writes a program with the image of modbus_slave.test
 * A slave of number 1 (RTU) with 2000 of each kind. Requests for holding register 100 + n get exception n; register 200 gets
 * no reply, 201 a reply of another unit, 202 half a reply, 203 a wrong checksum or protocol; then it works again. */
#include <errno.h>
#include <modbus.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int failures;

static void check(const char* what, int is_right) {
  printf("%s: %s\n", what, is_right ? "ok" : "WRONG");
  failures += !is_right;
}

static modbus_t* create(const char* kind, const char* where, int is_slave) {
  modbus_t* ctx = strcmp(kind, "tcp") == 0 ? modbus_new_tcp(is_slave ? "127.0.0.1" : "127.0.0.1", atoi(where))
                                           : modbus_new_rtu(where, 19200, 'E', 8, 1);
  if (ctx == NULL) exit(2);
  modbus_set_slave(ctx, 1);
  return ctx;
}

static void replyRaw(modbus_t* ctx, const char* kind, const uint8_t* query, int number) {
  const int is_tcp = strcmp(kind, "tcp") == 0;
  uint8_t frame[16] = {0};
  int size = 0;
  if (number == 200) return;
  if (is_tcp) {
    const uint8_t reply[] = {query[0], query[1], 0, number == 203 ? 9 : 0, 0, 5, number == 201 ? 77 : query[6], 3, 2, 0, 1};
    size = number == 202 ? 6 : sizeof reply;
    memcpy(frame, reply, sizeof reply);
  } else {
    const uint8_t right[] = {1, 3, 2, 0, 1, 0x79, 0x84};
    const uint8_t other[] = {2, 3, 2, 0, 1, 0x3d, 0x84};
    memcpy(frame, number == 201 ? other : right, sizeof right);
    if (number == 203) frame[6] ^= 1;
    size = number == 202 ? 4 : (int)sizeof right;
  }
  (void)!write(modbus_get_socket(ctx), frame, (size_t)size);
}

static int runSlave(const char* kind, const char* where) {
  const int is_tcp = strcmp(kind, "tcp") == 0;
  modbus_t* const ctx = create(kind, where, 1);
  modbus_mapping_t* const map = modbus_mapping_new(2000, 2000, 2000, 2000);
  int listener = -1, is_done = 0;
  for (int i = 0; i < 2000; ++i) {
    map->tab_bits[i] = (uint8_t)(i % 3 == 0);
    map->tab_input_bits[i] = (uint8_t)(i % 5 == 0);
    map->tab_registers[i] = (uint16_t)(i * 7);
    map->tab_input_registers[i] = (uint16_t)(60000 - i);
  }
  if (is_tcp) listener = modbus_tcp_listen(ctx, 1);
  if (!is_tcp && modbus_connect(ctx) != 0) return 2;
  while (!is_done) {
    uint8_t query[MODBUS_TCP_MAX_ADU_LENGTH];
    if (is_tcp && modbus_tcp_accept(ctx, &listener) < 0) return 2;
    for (;;) {
      int size;
      do size = modbus_receive(ctx, query);
      while (size == 0);
      if (size < 0 && !is_tcp) continue;
      if (size < 0) break;
      const int head = modbus_get_header_length(ctx);
      const int function = query[head], address = query[head + 1] << 8 | query[head + 2];
      if (function == 3 && address > 100 && address < 112)
        modbus_reply_exception(ctx, query, (unsigned)(address - 100));
      else if (function == 3 && address >= 200 && address <= 203)
        replyRaw(ctx, kind, query, address);
      else
        modbus_reply(ctx, query, size, map);
      if (function == 6 && address == 999) {
        is_done = 1;
        break;
      }
    }
    if (is_tcp) modbus_close(ctx);
  }
  printf("coils 20 to 23: %d%d%d%d, register 300: %d, registers 310 to 312: %d %d %d, coil 40: %d\n", map->tab_bits[20], map->tab_bits[21],
         map->tab_bits[22], map->tab_bits[23], map->tab_registers[300], map->tab_registers[310], map->tab_registers[311],
         (int16_t)map->tab_registers[312], map->tab_bits[40]);
  return 0;
}

static int runMaster(const char* kind, const char* where) {
  modbus_t* const ctx = create(kind, where, 0);
  uint16_t words[125];
  uint8_t bits[2000];
  for (int i = 0; modbus_connect(ctx) != 0; ++i) {
    if (i == 500) return 2;
    usleep(20000);
  }
  modbus_set_response_timeout(ctx, 2, 0);
  for (int i = 0; modbus_read_registers(ctx, 0, 1, words) != 1; ++i)
    if (i == 5) return 2;
  check("01 read coils", modbus_read_bits(ctx, 40, 8, bits) == 8 && bits[3] == 1 && bits[2] == 0);
  check("01 read 2000 coils of M", modbus_read_bits(ctx, 5000, 2000, bits) == 2000);
  check("02 read inputs", modbus_read_input_bits(ctx, 16, 16, bits) == 16 && bits[1] == 1 && bits[0] == 0);
  check("03 read registers", modbus_read_registers(ctx, 3, 2, words) == 2 && words[0] == 0x1234);
  check("03 read 125 registers of M", modbus_read_registers(ctx, 5000, 125, words) == 125 && words[1] == 0x4321);
  check("04 read input registers", modbus_read_input_registers(ctx, 1, 1, words) == 1 && words[0] == 0x0102);
  check("05 write coil", modbus_write_bit(ctx, 5000 + 63, 1) == 1);
  check("06 write register", modbus_write_register(ctx, 5000 + 100, 0xff9c) == 1);
  for (int i = 0; i < 1968; ++i) bits[i] = (uint8_t)(i % 7 == 0);
  check("15 write 1968 coils", modbus_write_bits(ctx, 5000 + 8000, 1968, bits) == 1968);
  for (int i = 0; i < 123; ++i) words[i] = (uint16_t)(i * 3);
  check("16 write 123 registers", modbus_write_registers(ctx, 5000 + 2000, 123, words) == 123);
  check("what was written is read", modbus_read_registers(ctx, 5000 + 2000, 123, words) == 123 && words[122] == 366);
  check("coils too", modbus_read_bits(ctx, 5000 + 8000, 1968, bits) == 1968 && bits[1966] == 0 && bits[1967] == 1 && bits[7] == 1);
  check("exception 2", modbus_read_registers(ctx, 512, 1, words) == -1 && errno == EMBXILADD);
  check("exception 2 at the end", modbus_read_registers(ctx, 5000 + 8192, 2, words) == -1 && errno == EMBXILADD);
  check("the last register", modbus_read_registers(ctx, 5000 + 8192, 1, words) == 1);
  const uint8_t too_many[] = {1, 3, 0, 0, 0, 126}, unknown[] = {1, 7, 0, 0};
  uint8_t reply[MODBUS_TCP_MAX_ADU_LENGTH];
  modbus_send_raw_request(ctx, too_many, sizeof too_many);
  const int head = modbus_get_header_length(ctx);
  check("exception 3", modbus_receive_confirmation(ctx, reply) > head + 1 && reply[head] == 0x83 && reply[head + 1] == 3);
  modbus_send_raw_request(ctx, unknown, sizeof unknown);
  check("exception 1", modbus_receive_confirmation(ctx, reply) > head + 1 && reply[head] == 0x87 && reply[head + 1] == 1);
  words[0] = 0;
  for (int i = 0; i < 200 && words[0] != 0xff9c; ++i) {  // a cycle later
    usleep(10000);
    modbus_read_registers(ctx, 5000 + 110, 1, words);
  }
  check("the program has what was written", words[0] == 0xff9c);
  modbus_write_bit(ctx, 5000 + 8 * 7, 1);
  modbus_close(ctx);
  return failures != 0;
}

int main(int argc, char** argv) {
  setvbuf(stdout, NULL, _IOLBF, 0);
  if (argc != 4) return 2;
  return strcmp(argv[1], "slave") == 0 ? runSlave(argv[2], argv[3]) : runMaster(argv[2], argv[3]);
}
