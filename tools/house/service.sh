#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# samples/service/plant.service under systemd itself, which runs as process 1 of a namespace of its own: starts, stops with
# SIGTERM and goes on warm, is killed and restarted, and stays down after a fault. Needs root and systemd; called by
# tools/long.sh.
#   tools/house/service.sh
set -eu
here=$(cd "$(dirname "$0")/../.." && pwd)

boot() {  # in the namespace: what systemd writes goes to file systems that end with it, and it has a cgroup of its own
  mount -t tmpfs tmpfs /sys/fs/cgroup
  mkdir /sys/fs/cgroup/systemd
  mount -t cgroup -o none,name=systemd cgroup /sys/fs/cgroup/systemd
  mount -t tmpfs tmpfs /run
  mount -t tmpfs tmpfs /opt
  mount -t tmpfs -o mode=755 tmpfs /var/lib
  mkdir -p /run/systemd/system/plant.service.d /run/lock /opt/plant
  for unit in systemd-udevd systemd-udev-trigger systemd-logind systemd-journald systemd-tmpfiles-setup systemd-sysctl \
    systemd-tmpfiles-setup-dev systemd-sysusers systemd-random-seed systemd-remount-fs systemd-modules-load systemd-binfmt; do
    ln -s /dev/null /run/systemd/system/$unit.service
  done
  for unit in systemd-journald.socket systemd-journald-dev-log.socket systemd-journald-audit.socket dev-hugepages.mount \
    dev-mqueue.mount sys-kernel-debug.mount sys-kernel-tracing.mount sys-kernel-config.mount \
    proc-sys-fs-binfmt_misc.automount systemd-update-utmp.service; do
    ln -s /dev/null "/run/systemd/system/$unit"
  done
  cp "$folder/plant" /opt/plant/plant
  cp "$here/samples/service/plant.service" /run/systemd/system/plant.service
  # No journal here: what the program prints goes to files.
  printf '[Service]\nStandardOutput=append:/run/plant.out\nStandardError=append:/run/plant.err\n' \
    > /run/systemd/system/plant.service.d/output.conf
  "$0" drive > "$folder/drive.out" 2>&1 &
  export container=lxc
  exec /lib/systemd/systemd --system --unit=basic.target --log-target=null
}

expect() {  # what, wanted, found
  if [ "$2" = "$3" ]; then echo "$1: $3"; else echo "WRONG: $1: $3 instead of $2"; touch "$folder/wrong"; fi
}
state() { systemctl show -p "$1" --value plant.service; }
wait_for() {  # property value
  for _ in $(seq 100); do [ "$(state "$1")" = "$2" ] && return; sleep 0.1; done
}
count() { sed -n 's/.*Main.count = //p' "$1" | tail -1; }

drive() {
  for _ in $(seq 100); do systemctl is-system-running 2>/dev/null | grep -q -E 'running|degraded' && break; sleep 0.2; done
  systemctl start plant
  sleep 2
  expect 'after start' active "$(state ActiveState)"
  pid=$(state MainPID)
  expect 'threads under SCHED_FIFO' yes "$(cat /proc/"$pid"/task/*/sched | grep -q '^policy .* 1$' && echo yes || echo "no ($(cat /run/plant.err))")"
  systemctl stop plant
  expect 'after stop' 'inactive success 0' "$(state ActiveState) $(state Result) $(state ExecMainStatus)"
  expect 'statistics at its end' 1 "$(grep -c '^task' /run/plant.out)"
  first=$(count /run/plant.out)
  systemctl start plant
  sleep 2
  systemctl stop plant
  second=$(count /run/plant.out)
  expect "goes on warm ($first to $second)" yes "$([ "$second" -gt "$((first + 150))" ] && echo yes || echo no)"
  systemctl start plant
  sleep 2
  pid=$(state MainPID)
  kill -9 "$pid"
  wait_for NRestarts 1
  wait_for ActiveState active
  sleep 2
  expect 'restarted after SIGKILL' 'active yes' "$(state ActiveState) $([ "$(state MainPID)" != "$pid" ] && echo yes || echo no)"
  systemctl stop plant
  third=$(count /run/plant.out)
  expect "nothing lost but the last second ($second to $third)" yes "$([ "$third" -gt "$((second + 250))" ] && echo yes || echo no)"
  sed -i 's/--realtime/--realtime --set Main.zero=0/' /run/systemd/system/plant.service
  systemctl daemon-reload
  systemctl start plant
  wait_for ActiveState failed
  expect 'after a fault' 'failed exit-code 3 0' "$(state ActiveState) $(state Result) $(state ExecMainStatus) $(state NRestarts)"
  expect 'the fault is named' yes "$(grep -q 'fault\[div\]: division by zero' /run/plant.err && echo yes || cat /run/plant.err)"
  touch "$folder/done"
}

case ${1:-} in
  boot) boot ;;
  drive) drive ;;
  *)
    [ "$(id -u)" = 0 ] && [ -x /lib/systemd/systemd ] || { echo "needs root and the package systemd"; exit 2; }
    folder=$(mktemp -d)
    chmod 755 "$folder"
    export folder
    trap 'rm -rf "$folder"' EXIT
    cat > "$folder/main.st" <<'END'
PROGRAM Main
VAR RETAIN count : DINT; END_VAR
VAR zero : DINT := 1; quotient : DINT; END_VAR
count := count + 1;
quotient := count / zero;
END_PROGRAM
END
    "${RUNG:-$here/build/bin/rung}" build "$folder/main.st" -o "$folder/plant" > /dev/null
    cgroup=/sys/fs/cgroup/systemd/rung.$$
    mkdir "$cgroup"
    trap 'rm -rf "$folder"; find "$cgroup" -depth -type d -exec rmdir {} + || true' EXIT
    sh -c 'echo $$ > '"$cgroup"'/cgroup.procs; exec "$@"' - \
      unshare --pid --fork --mount-proc --cgroup --uts --ipc --mount --kill-child "$0" boot > "$folder/boot.out" 2>&1 < /dev/null &
    for _ in $(seq 60); do
      [ -e "$folder/done" ] && break
      sleep 1
    done
    pkill -KILL -P $! || true  # process 1 of the namespace, and all in it
    wait || true
    cat "$folder/drive.out"
    [ -e "$folder/done" ] || { echo 'did not come to its end'; exit 1; }
    [ ! -e "$folder/wrong" ]
    ;;
esac
