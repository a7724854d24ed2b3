FROM python:3.13-slim AS build
COPY . /source
RUN pip wheel --no-cache-dir --no-deps --wheel-dir /wheels /source
FROM python:3.13-slim
COPY --from=build /wheels /wheels
RUN pip install --no-cache-dir "$(ls /wheels/equipoise-*.whl)[all]" && rm -r /wheels && useradd --create-home lab
USER lab
WORKDIR /home/lab
ENTRYPOINT ["equipoise"]
CMD ["--help"]
