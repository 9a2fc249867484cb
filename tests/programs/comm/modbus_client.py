# SPDX-License-Identifier: Apache-2.0
"""Reads and writes the program modbus_slave.iecst with pymodbus: modbus_client.py PORT|DEVICE. Prints what is wrong, then `done`."""
import logging
import sys
import time
from pymodbus.client import ModbusSerialClient, ModbusTcpClient

where = sys.argv[1]
logging.getLogger('pymodbus').setLevel(logging.CRITICAL)  # it is refused until the slave listens
client = ModbusTcpClient('127.0.0.1', port=int(where)) if where.isdigit() else ModbusSerialClient(
    port=where, baudrate=19200, parity='N', stopbits=1, bytesize=8, timeout=1)  # a pseudo-terminal has no parity
for _ in range(250):
    if client.connect():
        break
    time.sleep(0.02)
# A line takes bytes before the slave listens: the first answer says that it does.
for _ in range(20):
    if not client.read_holding_registers(3, 1, slave=1).isError():
        break


def check(what, is_right):
    if not is_right:
        print(what, 'WRONG')


check('registers', client.read_holding_registers(3, 1, slave=1).registers == [0x1234])
check('memory', client.read_holding_registers(5001, 1, slave=1).registers == [0x4321])
check('inputs', client.read_input_registers(1, 1, slave=1).registers == [0x0102])
check('input bits', client.read_discrete_inputs(16, 3, slave=1).bits[:3] == [False, True, False])
check('coils', client.read_coils(42, 2, slave=1).bits[:2] == [False, True])
check('write', not client.write_register(5100, 1234, slave=1).isError())
check('write many', not client.write_registers(5200, list(range(100)), slave=1).isError())
check('read many', client.read_holding_registers(5200, 100, slave=1).registers == list(range(100)))
check('write coils', not client.write_coils(9000, [True, False, True], slave=1).isError())
check('read coils', client.read_coils(9000, 3, slave=1).bits[:3] == [True, False, True])
check('exception', client.read_holding_registers(600, 1, slave=1).exception_code == 2)
check('function', client.read_exception_status(slave=1).isError())
for _ in range(200):
    if client.read_holding_registers(5110, 1, slave=1).registers == [1234]:
        break
    time.sleep(0.01)
else:
    print('the program has not what was written')
client.write_coil(5056, True, slave=1)
client.close()
print('done')
