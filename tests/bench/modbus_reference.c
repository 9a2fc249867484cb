// SPDX-License-Identifier: Apache-2.0
/* The reference of modbus.sh: a Modbus TCP server for many masters with libmodbus and select, as its own example for
 * bandwidth is made. Argument: the port. Holding register 3 is 16#1234, which flood.c checks. */
#include <modbus.h>
#include <stdlib.h>
#include <sys/select.h>
#include <unistd.h>

int main(int argc, char** argv) {
  modbus_t* const ctx = modbus_new_tcp("127.0.0.1", argc > 1 ? atoi(argv[1]) : 1502);
  modbus_mapping_t* const map = modbus_mapping_new(0, 0, 100, 0);
  uint8_t query[MODBUS_TCP_MAX_ADU_LENGTH];
  fd_set all, ready;
  if (ctx == NULL || map == NULL) return 1;
  map->tab_registers[3] = 0x1234;
  const int server = modbus_tcp_listen(ctx, 512);
  int listener = server, highest = server;
  if (server < 0) return 1;
  FD_ZERO(&all);
  FD_SET(server, &all);
  for (;;) {
    ready = all;
    if (select(highest + 1, &ready, NULL, NULL, NULL) < 0) return 1;
    for (int fd = 0; fd <= highest; ++fd) {
      if (!FD_ISSET(fd, &ready)) continue;
      if (fd == server) {
        const int client = modbus_tcp_accept(ctx, &listener);
        if (client < 0) continue;
        if (client >= FD_SETSIZE) {
          close(client);
          continue;
        }
        FD_SET(client, &all);
        if (client > highest) highest = client;
        continue;
      }
      modbus_set_socket(ctx, fd);
      const int size = modbus_receive(ctx, query);
      if (size > 0) {
        modbus_reply(ctx, query, size, map);
      } else if (size < 0) {
        close(fd);
        FD_CLR(fd, &all);
      }
    }
  }
}
