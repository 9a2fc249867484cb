# SPDX-License-Identifier: Apache-2.0
"""A Modbus slave made with pymodbus for modbus_master.iecst: modbus_server.py PORT|DEVICE. Prints what was written, once it is complete."""
import os
import sys
import threading
import time
from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.server import StartSerialServer, StartTcpServer
from pymodbus.transaction import ModbusRtuFramer

where = sys.argv[1]
coils = ModbusSequentialDataBlock(0, [i % 3 == 0 for i in range(2100)])
inputs = ModbusSequentialDataBlock(0, [i % 5 == 0 for i in range(2100)])
holding = ModbusSequentialDataBlock(0, [(i * 7) & 0xffff for i in range(1000)])
registers = ModbusSequentialDataBlock(0, [(60000 - i) & 0xffff for i in range(1000)])
slave = ModbusSlaveContext(di=inputs, co=coils, hr=holding, ir=registers, zero_mode=True)
context = ModbusServerContext(slaves=slave, single=True)


def report():
    while holding.getValues(310, 3) != [1, 20000, 0xfffd]:
        time.sleep(0.02)
    bits = ''.join(str(int(bit)) for bit in coils.getValues(20, 4))
    print(f'coils 20 to 23: {bits}, register 300: {holding.getValues(300, 1)[0]}, coil 40: {int(coils.getValues(40, 1)[0])}', flush=True)
    time.sleep(0.3)  # the reply to the last request
    os._exit(0)


threading.Thread(target=report, daemon=True).start()
if where.isdigit():
    StartTcpServer(context=context, address=('127.0.0.1', int(where)))
else:
    StartSerialServer(context=context, port=where, framer=ModbusRtuFramer, baudrate=19200, parity='N', stopbits=1, bytesize=8)
