#!/bin/sh
# Links the library without what crates for drawing offer to a generator of bindings: the page calls three names alone.
left=$#
while [ "$left" -gt 0 ]; do
  word=$1; shift; left=$((left - 1))
  if [ "$word" = --export ]; then
    name=$1; shift; left=$((left - 1))
    case $name in room | ask | answer) set -- "$@" --export "$name" ;; esac
  else
    set -- "$@" "$word"
  fi
done
exec "$(rustc --print sysroot)/lib/rustlib/$(rustc --version --verbose | sed -n 's/^host: //p')/bin/rust-lld" "$@"
