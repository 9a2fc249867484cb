// SPDX-License-Identifier: Apache-2.0
/* Load for a Modbus TCP server: flood PORT SECONDS CONNECTIONS HOSTILE
 * CONNECTIONS masters read 10 registers as fast as they get replies, each checked. HOSTILE other peers meanwhile send noise, halves of
 * frames, or requests whose replies they never read, vanish and come again. Prints `requests per second` and `wrong`. */
#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { REQUEST = 12, REPLY = 9 + 20 };

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + (double)now.tv_nsec / 1e9;
}

static int dial(int port) {
  struct sockaddr_in peer = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port), .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
  const int fd = socket(AF_INET, SOCK_STREAM, 0), on = 1;
  for (int i = 0; connect(fd, (struct sockaddr*)&peer, sizeof peer) != 0; ++i) {
    if (i == 500) exit(2);
    usleep(10000);
  }
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  fcntl(fd, F_SETFL, O_NONBLOCK);
  return fd;
}

static void ask(int fd, unsigned transaction) {
  const uint8_t request[REQUEST] = {(uint8_t)(transaction >> 8), (uint8_t)transaction, 0, 0, 0, 6, 1, 3, 0, 0, 0, 10};
  (void)!send(fd, request, sizeof request, MSG_NOSIGNAL);
}

static void harass(int fd, int kind) {
  uint8_t bytes[600];
  for (size_t i = 0; i < sizeof bytes; ++i) bytes[i] = (uint8_t)rand();
  switch (kind % 3) {
    case 0: (void)!send(fd, bytes, sizeof bytes, MSG_NOSIGNAL); break;
    case 1: (void)!send(fd, "\0\1\0\0\0\6\1", 7, MSG_NOSIGNAL); break;
    default:
      for (int i = 0; i < 100; ++i) ask(fd, (unsigned)i);
  }
}

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const int port = atoi(argv[1]), masters = atoi(argv[3]), hostile = atoi(argv[4]);
  const double end = seconds() + atof(argv[2]), begin = seconds();
  struct pollfd* const fds = calloc((size_t)masters, sizeof *fds);
  unsigned* const transactions = calloc((size_t)masters, sizeof *transactions);
  int* const others = calloc((size_t)hostile + 1, sizeof *others);
  long replies = 0, wrong = 0;
  for (int i = 0; i < masters; ++i) fds[i] = (struct pollfd){dial(port), POLLIN, 0};
  for (int i = 0; i < hostile; ++i) others[i] = dial(port);
  for (int i = 0; i < masters; ++i) ask(fds[i].fd, 0);
  for (double now = seconds(), next = now; now < end; now = seconds()) {
    poll(fds, (nfds_t)masters, 10);
    for (int i = 0; i < masters; ++i) {
      uint8_t reply[64];
      if (fds[i].revents == 0) continue;
      const ssize_t size = recv(fds[i].fd, reply, sizeof reply, 0);
      if (size < 0 && errno == EAGAIN) continue;
      wrong += size != REPLY || (reply[0] << 8 | reply[1]) != (int)(transactions[i] & 0xffff) || reply[7] != 3 || reply[8] != 20 ||
               reply[15] != 0x12 || reply[16] != 0x34;
      ++replies;
      if (size <= 0) fds[i].fd = -1;
      ask(fds[i].fd, ++transactions[i]);
    }
    if (now < next) continue;
    next = now + 0.01;
    for (int i = 0; i < hostile; ++i) {
      harass(others[i], i);
      if (rand() % 20 != 0) continue;
      const struct linger reset = {1, 0};
      if (rand() % 2 == 0) setsockopt(others[i], SOL_SOCKET, SO_LINGER, &reset, sizeof reset);
      close(others[i]);
      others[i] = dial(port);
    }
  }
  printf("requests per second: %.0f\nwrong: %ld\n", (double)replies / (seconds() - begin), wrong);
  return wrong != 0 || replies < masters;
}
