#!/usr/bin/env bash
# Succeeds if the server of this machine says that it is ready. Needs nothing but bash.
set -euo pipefail
port=${ADAPTARM_BIND:-127.0.0.1:8080}
port=${port##*:}
exec 3<>"/dev/tcp/127.0.0.1/$port"
printf 'GET /readyz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n' >&3
IFS= read -r -t 4 status <&3
[[ $status == 'HTTP/1.1 200 '* ]]
