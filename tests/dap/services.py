#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Programs that talk to the world go forward, back and forward again: each cycle begins with the same memory whenever the
# program comes there, and what it sends and writes leaves once.
#   services.py [--seed S] [--programs N]
# Sockets, serial lines (pseudo-terminals) and files are real; the peers answer each message with its echo.
import argparse
import os
import random
import socket
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import Client  # noqa: E402

CYCLES = 25

COMMON = """
  out : STRING := '{text}'; in : STRING; sent, got, cycle : DINT; done : R_TRIG; {vars}
END_VAR
cycle := cycle + 1;
{code}
END_PROGRAM
"""

TCP = {
    "vars": "c : ICP_TCP_Comm_Client; r : ICP_TCP_Comm_Read; w : ICP_TCP_Comm_Write;",
    "code": """c(Enable := TRUE, RecvIP := '127.0.0.1', Port_Recv := {port}, Timeout := 2000);
w(Execute := c.Active AND cycle MOD {step} <> 0, TCPConnection := c.TCPConnection, DataSize := {size}, DataPtr_Recv := ADR(out));
done(CLK := w.Done);
IF done.Q THEN sent := sent + {size}; END_IF
r(Enable := c.Active, TCPConnection := c.TCPConnection, DataSize := 80, DataPtr_Recv := ADR(in));
IF r.Ready THEN got := got + UDINT_TO_DINT(r.Count); END_IF""",
}
UDP = {
    "vars": "r : ICP_UDP_Comm_Receive; s : ICP_UDP_Comm_Send;",
    "code": """s(Enable := cycle MOD 6 <> 0, Send_IP := '127.0.0.1', Port_Send := {own}, Recv_IP := '127.0.0.1', Port_Recv := {port}, DataSize := {size}, DataPtr_Send := ADR(out));
r(Enable := TRUE, RecvIP := '127.0.0.1', Port_Recv := {own}, DataSize := 80, DataPtr_Recv := ADR(in));
IF r.xReady THEN got := got + {size}; END_IF""",
}
SERIAL = {
    "vars": "port : ICP_Serial_Comm_hCom; r : ICP_Serial_Comm_Read; w : ICP_Serial_Comm_Write;",
    "code": """port(Enable := TRUE, udiPort := 1, udiBaudrate := 115200, iParity := COM.PARITY.NONE, iStopBits := COM.STOPBIT.ONESTOPBIT, udiTimeout := 1000);
w(xExecute := port.xDone AND cycle MOD {step} <> 0, hCom := port.hCom, write_szSize := {size}, pWriteData := ADR(out), udiTimeOut := 1000);
r(xExecute := port.xDone AND NOT r.xDone, hCom := port.hCom, read_szSize := {size}, pReadData := ADR(in), udiTimeOut := 5000);
done(CLK := w.xDone);
IF done.Q THEN sent := sent + {size}; END_IF
IF r.xDone THEN got := got + LEN(in); END_IF""",
}
FILE = {
    "vars": "h : RTS_IEC_HANDLE; result : RTS_IEC_RESULT; n : RTS_IEC_SIZE;",
    "code": """IF cycle MOD {step} = 0 THEN
  h := SysFileOpen('log.txt', AM_APPEND_PLUS, ADR(result));
  n := SysFileWrite(h, ADR(out), {size}, ADR(result));
  sent := sent + ULINT_TO_DINT(n);
  result := SysFileSetPos(h, 0);
  n := SysFileRead(h, ADR(in), 80, ADR(result));
  got := got + ULINT_TO_DINT(n);
  result := SysFileClose(h);
END_IF""",
}


class Peer:
    """Echoes what it receives, and counts."""

    def __init__(self, kind):
        self.received = 0
        self.device = None
        self.port = 0
        if kind == "serial":
            self.master, slave = os.openpty()
            os.set_blocking(self.master, True)
            self.device = os.ttyname(slave)
            self.slave = slave
            target = self.serve_serial
        elif kind == "tcp":
            self.socket = socket.socket()
            self.socket.bind(("127.0.0.1", 0))
            self.socket.listen(1)
            self.port = self.socket.getsockname()[1]
            target = self.serve_tcp
        else:
            self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            self.socket.bind(("127.0.0.1", 0))
            self.port = self.socket.getsockname()[1]
            target = self.serve_udp
        threading.Thread(target=target, daemon=True).start()

    def serve_tcp(self):
        connection, _ = self.socket.accept()
        while data := connection.recv(4096):
            self.received += len(data)
            connection.sendall(data)

    def serve_udp(self):
        while True:
            data, sender = self.socket.recvfrom(4096)
            self.received += len(data)
            self.socket.sendto(data, sender)

    def serve_serial(self):
        while True:
            try:
                data = os.read(self.master, 4096)
            except OSError:
                return
            self.received += len(data)
            os.write(self.master, data)


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Run:
    def __init__(self, kind, chance, folder):
        self.kind = kind
        self.folder = folder
        self.problems = []
        self.values = {}
        text = "".join(chance.choice("abcdefgh") for _ in range(chance.randint(1, 20)))
        self.most = len(text)  # that is on its way
        self.peer = None if kind == "file" else Peer(kind)
        part = {"tcp": TCP, "udp": UDP, "serial": SERIAL, "file": FILE}[kind]
        values = {
            "text": text,
            "size": len(text),
            "step": chance.randint(2, 5),
            "port": self.peer.port if self.peer else 0,
            "own": free_port(),
        }
        source = "PROGRAM Main\nVAR" + COMMON.format(
            text=text, vars=part["vars"], code=part["code"].format(**values))
        with open(os.path.join(folder, "main.st"), "w") as file:
            file.write(source)
        self.client = Client()
        self.client.request("initialize", {"adapterID": "rung"})
        arguments = ["-Wno-all", "--cycles", str(CYCLES), "--files-root", folder]
        if self.peer and self.peer.device:
            arguments += ["--serial", "1=" + self.peer.device]
        answer = self.client.request(
            "launch", {"program": os.path.join(folder, "main.st"), "args": arguments, "stopOnEntry": True})
        if not answer["success"]:
            self.problems.append(answer["message"])

    def request(self, command, arguments):
        self.client.request(command, arguments)
        return self.client.wait("stopped", "terminated", "end")["event"]

    def go(self, chance):
        if self.problems:
            return
        self.request("configurationDone", {})
        known = {}
        last = CYCLES - 1
        order = list(range(1, last)) + [chance.randint(1, last - 1) for _ in range(10)]
        order += sorted(order[-10:]) + [last]
        for cycle in order:
            self.request("rung/gotoCycle", {"cycle": cycle})
            value = self.client.request("rung/memoryHash")["body"]["hash"]
            if known.setdefault(cycle, value) != value:
                return self.problems.append(f"cycle {cycle} has another memory when it comes again")
        values = {}
        for name in ("sent", "got"):
            answer = self.client.request("evaluate", {"expression": "Main." + name})
            values[name] = int(answer["body"]["result"])
        self.compare(values)
        return None

    # The peer reads when it gets the processor.
    def wait_for(self, count):
        for _ in range(500):
            if self.peer.received >= count:
                return
            time.sleep(0.02)

    def compare(self, values):
        if self.kind != "file":
            self.wait_for(values["got" if self.kind == "udp" else "sent"])
        if self.kind == "file":
            path = os.path.join(self.folder, "log.txt")
            size = os.path.getsize(path) if os.path.exists(path) else 0
            if size != values["sent"]:
                self.problems.append(f"the file has {size} bytes of {values['sent']}")
        elif self.kind == "udp":
            # What the program got is an echo of what it sent: no datagram was sent twice.
            if self.peer.received < values["got"]:
                self.problems.append(f"{self.peer.received} bytes arrived, {values['got']} came back")
        elif not values["sent"] <= self.peer.received <= values["sent"] + self.most:
            self.problems.append(f"{self.peer.received} bytes arrived of {values['sent']}")
        self.values = values


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--programs", type=int, default=8)
    parser.add_argument("-v", action="store_true")
    options = parser.parse_args()
    differences = arrived = 0
    for number in range(options.programs):
        chance = random.Random(options.seed * 1000 + number)
        kind = ("tcp", "file", "udp", "serial")[number % 4]
        with tempfile.TemporaryDirectory() as folder:
            run = Run(kind, chance, folder)
            run.go(chance)
            run.client.end()
            arrived += 1 if kind == "file" or run.peer.received > 0 else 0
            if "-v" in sys.argv:
                print(kind, run.values, run.peer and run.peer.received)
            for problem in run.problems:
                differences += 1
                print(f"program {options.seed}.{number} ({kind}): {problem}", flush=True)
    print(f"{options.programs} programs, {arrived} sent something, {differences} differences")
    sys.exit(1 if differences or arrived != options.programs else 0)


if __name__ == "__main__":
    main()
