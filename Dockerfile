# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
# An image with the packages of tools/package, without compiler and sources. It needs Docker 23, podman or buildah:
#   docker build -t mechanism_codesign .
#   docker run --rm --user "$(id -u):$(id -g)" -v "$PWD:/work" mechanism_codesign       # the demo: tunes the slider-crank; writes job/ and job.html
#   docker run --rm --user "$(id -u):$(id -g)" -v "$PWD:/work" mechanism_codesign codesign optimize model.urdf study.yaml --output job
# With Debian's ROS, for nodes, launch files and bags:
#   docker build -t mechanism_codesign_ros --build-arg PACKAGES="mechanism-codesign python3-mechanism-codesign ros-mechanism-codesign" .
#   docker run --rm --network host mechanism_codesign_ros roslaunch mechanism_codesign simulate.launch rviz:=false
ARG RELEASE=bookworm
FROM debian:${RELEASE}-slim AS build
COPY . /src/mechanism_codesign
WORKDIR /src/mechanism_codesign
RUN tools/package

FROM debian:${RELEASE}-slim
ARG PACKAGES="mechanism-codesign python3-mechanism-codesign"
RUN --mount=type=bind,from=build,source=/src/mechanism_codesign/build/package,target=/packages \
    apt-get update && cd /packages && for package in $PACKAGES; do set -- "$@" ./"${package}"_*.deb; done && \
    DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" && rm -rf /var/lib/apt/lists/*
# The user of --user has no home where ROS could write.
ENV ROS_HOME=/tmp/ros
WORKDIR /work
CMD codesign optimize /usr/share/mechanism_codesign/urdf/slider_crank.urdf /usr/share/mechanism_codesign/config/slider_crank.yaml --output job && \
    codesign report job -o job.html
