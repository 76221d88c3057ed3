# The tables of a study in R: fracas export STUDY; Rscript tables_with_R.R
#
# Prints the mean size by rate from the points and again from the fragments, quantiles of normalised sizes and a survival curve,
# and draws that into survival.pdf. Needs jsonlite. A test runs it.
library(jsonlite)
folder <- "STUDY/export"
package <- fromJSON(file.path(folder, "datapackage.json"), simplifyVector = FALSE)
kind <- c(integer = "integer", number = "numeric", string = "character")
read_table <- function(resource) {
  types <- vapply(resource$schema$fields, function(field) kind[[field$type]], "")
  read.csv(file.path(folder, resource$path), colClasses = types, na.strings = "", check.names = FALSE)
}
tables <- lapply(package$resources, read_table)
names(tables) <- vapply(package$resources, function(resource) resource$name, "")
unit_of <- function(table, column) {
  fields <- package$resources[[match(table, names(tables))]]$schema$fields
  Filter(function(field) field$name == column, fields)[[1]]$unit
}

points <- tables$points; realizations <- tables$realizations; fragments <- tables$fragments
cat(package$campaign, package$seed, package$program_version, "\n")
cat(nrow(points), "points,", nrow(realizations), "realizations,", nrow(fragments), "fragments\n")
cat("a size is in", unit_of("fragments", "size"), "\n")
rate <- "derived.strain_rate"
by_rate <- points[order(points[[rate]]), c(rate, "size.n", "size.mean", "size.half_width")]
print(by_rate, row.names = FALSE)
used <- realizations[realizations$outcome %in% c("FRAGMENTED", "INTACT", "TIME_LIMIT"), ]
used <- merge(used, points[c("point", rate)], by = "point")
used <- merge(used, aggregate(size ~ point + replica, fragments, mean), by = c("point", "replica"))
interval <- function(size) {
  n <- length(size)
  c(n = n, mean = mean(size), half_width = qt(0.975, n - 1) * sd(size) / sqrt(n))
}
again <- do.call(rbind, tapply(used$size, used[[rate]], interval))
print(again)
sizes <- merge(fragments, points[c("point", rate, "scale.size")], by = "point")
sizes$normalised <- sizes$size / sizes$scale.size
print(aggregate(sizes["normalised"], sizes[rate], quantile, probs = c(0.1, 0.5, 0.9)))
fastest <- sizes[sizes[[rate]] == max(sizes[[rate]]) & sizes$dust == 0, ]
size <- sort(unique(fastest$size))                       # sizes are multiples of the element size: many are equal
survival <- 1 - c(0, head(ecdf(fastest$size)(size), -1)) # at each size, before it falls
print(head(data.frame(size, survival)), row.names = FALSE)
pdf("survival.pdf", width = 6, height = 4)
plot(size, survival, type = "S", log = "y", xlab = "size s [m]", ylab = "share of fragments of at least s")
invisible(dev.off())
